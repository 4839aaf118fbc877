// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/page.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "hal/base/utf8.h"

namespace relievo::pipeline::report {
namespace {

// Blue and orange for left and right, and outlines beside colours everywhere: whoever confuses red and green
// reads all of it.
constexpr std::string_view kStyle = R"css(
:root { --ink: #1a2026; --soft: #5d6873; --line: #d9dee3; --wash: #f5f7f9; --left: #1f63ad; --right: #c45a0b;
  --good: #14703f; --fair: #8a5a00; --bad: #b0241b; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "Noto Sans", Arial, sans-serif;
  font-variant-numeric: tabular-nums lining-nums; -webkit-text-size-adjust: 100%; overflow-wrap: break-word; }
main { max-width: 1060px; margin: 0 auto; padding: 44px 30px 72px; }
h1, h2, h3, p, ul, figure { margin: 0; padding: 0; }
h1 { font-size: 34px; line-height: 1.15; font-weight: 650; letter-spacing: -0.02em; }
h2 { font-size: 20px; line-height: 1.3; font-weight: 650; letter-spacing: -0.01em; margin-bottom: 6px; }
h3 { font-size: 14px; font-weight: 600; margin-bottom: 8px; }
section { margin-top: 48px; }
.lead { color: var(--soft); max-width: 74ch; margin-bottom: 16px; }
.product { color: var(--soft); font-size: 14px; letter-spacing: 0.02em; margin-bottom: 4px; }
.facts { list-style: none; display: flex; flex-wrap: wrap; gap: 2px 12px; margin-top: 10px; color: var(--soft); }
.facts li { overflow-wrap: anywhere; }
.facts li:not(:last-child)::after { content: "·"; margin-left: 12px; }

.verdict { display: grid; grid-template-columns: minmax(200px, 260px) 1fr; gap: 12px 32px; align-items: start; margin-top: 28px;
  padding: 22px 26px; border: 1px solid; border-left-width: 8px; border-radius: 6px; }
.verdict .stamp { display: flex; gap: 16px; align-items: center; }
.verdict .stamp svg { width: 52px; height: 52px; flex: none; fill: none; stroke: #fff; stroke-width: 5; stroke-linecap: round; stroke-linejoin: round; }
.verdict circle, .verdict .body { fill: currentColor; stroke: currentColor; stroke-width: 2; }
.verdict h2 { font-size: 30px; line-height: 1.1; margin: 0; }
.verdict .stamp p { color: var(--ink); font-size: 14px; line-height: 1.35; margin-top: 3px; }
.verdict ul { color: var(--ink); padding-left: 18px; align-self: center; max-width: 78ch; overflow-wrap: anywhere; }
.verdict .omitted { grid-column: 1 / -1; color: var(--ink); font-size: 14px; overflow-wrap: anywhere; }
.verdict a { color: inherit; }
.verdict li + li { margin-top: 6px; }
.pass { color: var(--good); background: #f2f9f5; }
.usable { color: var(--fair); background: #fdf8ec; }
.refuse { color: var(--bad); background: #fdf3f2; }

.face { margin-top: 34px; }
.tiles { display: grid; grid-template-columns: repeat(5, minmax(0, 1fr)); gap: 0; margin-top: 12px; border-top: 1px solid var(--ink);
  border-bottom: 1px solid var(--line); }
.tiles div { padding: 12px 14px 14px; border-left: 1px solid var(--line); }
.tiles div:first-child { padding-left: 0; border-left: 0; }
.tiles h3 { margin: 0; color: var(--soft); font-weight: 500; }
.tiles p { color: var(--soft); font-size: 13px; line-height: 1.35; }
.tiles .large { color: var(--ink); font-size: 27px; line-height: 1.25; font-weight: 650; letter-spacing: -0.01em; margin: 2px 0 4px; white-space: nowrap; }
.tiles .large i { font-size: 16px; font-weight: 400; letter-spacing: 0; }

table { border-collapse: collapse; width: 100%; }
th { text-align: left; font-weight: 500; }
thead th { color: var(--soft); font-size: 13px; font-weight: 500; padding: 0 12px 6px 0; border-bottom: 1px solid var(--ink); vertical-align: bottom; }
td, tbody th { padding: 7px 12px 7px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
.value { text-align: right; white-space: nowrap; }
i { font-style: normal; color: var(--soft); font-size: 0.9em; }
small { display: block; color: var(--soft); font-size: 13px; font-weight: 400; line-height: 1.35; }
.key { margin-top: 12px; }
.key tbody th { width: 46%; line-height: 1.35; }
.key td.value { font-size: 17px; font-weight: 600; line-height: 1.3; padding-right: 34px; }
.key thead .value { padding-right: 34px; }
.key td.value i { font-weight: 400; }
.key .second { font-size: 14px; font-weight: 400; color: var(--soft); }
.key .aim { color: var(--soft); }
.mark { white-space: nowrap; font-weight: 600; }
.mark b { display: inline-block; width: 18px; height: 18px; line-height: 18px; border-radius: 50%; color: #fff; text-align: center;
  font-size: 12px; margin-right: 4px; }
.good { color: var(--good); } .good b { background: var(--good); }
.fair { color: var(--fair); } .fair b { background: var(--fair); border-radius: 3px; }
.bad { color: var(--bad); } .bad b { background: var(--bad); border-radius: 0; }
.open { color: var(--soft); font-weight: 400; }
.reading { background: var(--wash); padding: 18px 22px; border-radius: 6px; margin-top: 28px; }
.reading h2 { font-size: 15px; }
.reading p { max-width: 96ch; }

.pair { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 26px 40px; align-items: start; margin-top: 8px; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: 13px; line-height: 1.45; margin-top: 8px; }
svg text { font-size: 13px; fill: var(--ink); font-variant-numeric: tabular-nums; }
svg .tick { fill: #48525c; } svg .label { fill: var(--soft); } svg .note { fill: var(--soft); font-size: 12px; }
svg .halo { paint-order: stroke; stroke: #fff; stroke-width: 4px; stroke-linejoin: round; }
svg .end { text-anchor: end; } svg .middle { text-anchor: middle; }
svg line, svg path { fill: none; stroke-linecap: round; stroke-linejoin: round; }
svg .axis { stroke: #48525c; stroke-width: 1; } svg .grid { stroke: #cfd6dc; stroke-width: 0.8; }
svg .frame { fill: none; stroke: #48525c; stroke-width: 1; }
svg .held { fill: #eef2f6; } svg .marker { stroke: #7b8791; stroke-dasharray: 2 4; }
svg .series { stroke-width: 2.2; stroke: var(--ink); } svg .point { fill: var(--ink); stroke: #fff; stroke-width: 1.2; }
svg .series.worst { stroke: #8d98a3; stroke-dasharray: 6 4; } svg .point.worst { fill: #fff; stroke: #8d98a3; stroke-width: 1.8; }
svg rect:not([class]) { shape-rendering: crispEdges; }
svg .gap { fill: #f5f0ea; } svg .gapline { stroke: #d3c6b6; stroke-width: 1; }
svg .outline { stroke-width: 1; opacity: 0.45; } svg .dots { stroke-width: 3; opacity: 0.85; }
svg .arrows { stroke-width: 0.9; }
svg .left { stroke: var(--left); } svg .right { stroke: var(--right); } svg .other { stroke: #8d98a3; }
svg .outline.other { stroke-dasharray: 4 3; }
svg .found { stroke: #ff2d78; stroke-width: 1.7; opacity: 1; } svg .found.large { stroke-width: 2.8; }
svg .bar { stroke: none; opacity: 0.55; } svg .bar.left { fill: var(--left); } svg .bar.right { fill: var(--right); }
svg .curve { stroke: var(--ink); stroke-width: 1.4; }
svg .field { stroke-width: 1; } svg .field.left { fill: rgba(31, 99, 173, 0.07); } svg .field.right { fill: rgba(196, 90, 11, 0.07); }
svg .camera { stroke-width: 1.2; } svg .camera.left { fill: var(--left); } svg .camera.right { fill: var(--right); }
svg .board.used { stroke: var(--ink); stroke-width: 1.1; fill: rgba(26, 32, 38, 0.08); }
svg .board.other { stroke: #8d98a3; stroke-width: 1; stroke-dasharray: 4 3; }
svg .volume { stroke: var(--good); stroke-width: 1.4; stroke-dasharray: 5 4; fill: rgba(20, 112, 63, 0.06); }
svg .measure { stroke: var(--ink); stroke-width: 1; } svg .ruler { stroke: var(--ink); stroke-width: 1.4; }

.views { font-size: 14px; table-layout: fixed; } .views thead small { font-size: 12px; } .views thead .value { width: 7.4%; }
.views thead th:nth-child(1) { width: 8.5%; } .views thead th:nth-child(2) { width: 31%; }
.views tbody th { font-weight: 600; padding-left: 10px; overflow-wrap: anywhere; }
.views thead th:first-child { padding-left: 10px; }
.views .thumbs { display: flex; gap: 4px; }
.views .thumbs svg { flex: 1 1 0; min-width: 0; height: auto; }
.views .links { font-size: 12px; margin-top: 2px; }
.views a { color: var(--soft); margin-right: 10px; }
.views .state { overflow-wrap: anywhere; }
.views .state p { font-size: 13px; line-height: 1.4; margin-top: 3px; }
.views .out { background: #fdf3f2; box-shadow: inset 4px 0 0 var(--bad); }
.numbers { font-size: 14px; margin-top: 10px; }
.numbers caption { text-align: left; font-weight: 600; padding-bottom: 6px; }
.numbers td, .numbers tbody th { padding-top: 4px; padding-bottom: 4px; }
.numbers .sigma { color: var(--soft); white-space: nowrap; text-align: left; padding-left: 0; }
.numbers thead th[colspan] { text-align: center; }
.numbers.set { margin-top: 26px; } .numbers.set th { width: 11em; color: var(--soft); } .numbers.set td { overflow-wrap: anywhere; }
.numbers.matrix { margin-top: 20px; }
.scroll { overflow-x: auto; }

@media screen and (max-width: 760px) {
  main { padding: 24px 16px 48px; }
  h1 { font-size: 28px; }
  section { margin-top: 36px; }
  .verdict { grid-template-columns: 1fr; padding: 18px; }
  .pair { grid-template-columns: minmax(0, 1fr); }
  .tiles { grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); }
  .tiles div, .tiles div:first-child { padding: 10px 12px 10px 0; border-left: 0; border-bottom: 1px solid var(--line); }
  .key thead, .views thead { display: none; }
  .key tr { display: grid; grid-template-columns: 1fr auto; gap: 0 12px; padding: 9px 0; border-bottom: 1px solid var(--line); }
  .key th, .key td, .key tbody th { border: 0; padding: 0; width: auto; }
  .key td.value { padding: 0; }
  .key td.value br { display: none; } .key .second { margin-left: 6px; }
  .key .aim { font-size: 13px; } .key .aim::before { content: "good: "; }
  .key .mark { float: right; }
  svg text { font-size: 16px; } svg .note { font-size: 15px; }
  .views tr { display: grid; grid-template-columns: 1fr 1fr; gap: 4px 16px; padding: 12px; border-bottom: 1px solid var(--line); }
  .views th, .views td, .views tbody th, .views .state { border: 0; padding: 0; width: auto; }
  .views th, .views td:nth-child(2), .views .state { grid-column: 1 / -1; }
  .views td.value { display: flex; justify-content: space-between; }
  .views td.value::before { content: attr(data-label); color: var(--soft); }
}
@page { size: A4; margin: 14mm 14mm 16mm; }
@media print {
  body { font-size: 9.5pt; line-height: 1.42; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  section { margin-top: 18pt; }
  h1 { font-size: 21pt; } h2 { font-size: 13pt; break-after: avoid; }
  .lead { break-after: avoid; break-inside: avoid; margin-bottom: 8pt; }
  .product, .facts { font-size: 9pt; }
  .verdict { margin-top: 12pt; padding: 10pt 14pt; gap: 8pt 18pt; grid-template-columns: 150pt 1fr; }
  .verdict h2 { font-size: 20pt; } .verdict .stamp svg { width: 40px; height: 40px; } .verdict .stamp p { font-size: 9pt; }
  .verdict ul, .verdict .omitted { font-size: 9pt; } .verdict li + li { margin-top: 2pt; }
  .face { margin-top: 13pt; } .tiles div { padding: 6pt 8pt 7pt; } .tiles .large { font-size: 16pt; } .tiles .large i { font-size: 10pt; }
  .tiles h3, .tiles p { font-size: 8pt; }
  .reading { margin-top: 12pt; padding: 9pt 12pt; font-size: 9pt; } .reading h2 { font-size: 10pt; }
  figure, .verdict, .reading, .pair, .views tr, .key tr, .numbers { break-inside: avoid; }
  .pair.tables { grid-template-columns: minmax(0, 1fr); }
  thead { display: table-header-group; }
  .key { margin-top: 4pt; } .key td, .key tbody th { padding-top: 2pt; padding-bottom: 2pt; } small { font-size: 7.5pt; }
  .key td.value { font-size: 11pt; padding-right: 20px; } .key .second { font-size: 9pt; } .key .aim { font-size: 9pt; }
  .views, .numbers, figcaption, .views .state p { font-size: 8.5pt; }
  .scroll { overflow: visible; } .scroll table, .scroll table thead th { font-size: 7.5pt; }
  .scroll table thead small, .scroll table td small { font-size: 6.5pt; }
  .scroll table th, .scroll table td, .scroll table tbody th { padding-left: 4px; padding-right: 4px; }
  .views .links { display: none; } .views thead th { font-size: 8pt; padding-right: 8px; } .views td { padding-right: 8px; }
  .views thead th:nth-child(2) { width: 28%; } .views thead .value { width: 8.2%; }
  svg text { font-size: 15px; } svg .note { font-size: 14px; }
}
)css";

constexpr std::string_view kUnknown = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view kMinus = "\xE2\x88\x92";
constexpr std::string_view kDash = "\xE2\x80\x93";

std::string fixed(double value, int decimals) {
  std::array<char, 400> text{};
  const auto done =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  std::string out(text.data(), done.ptr);
  // "-0.00" is nought.
  if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

}  // namespace

std::string page(std::string_view title, std::string_view more_style, std::string_view body) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>\n";
  out.append(kStyle).append(more_style).append("</style>\n</head>\n<body>\n<main>\n").append(body);
  return out + "</main>\n</body>\n</html>\n";
}

std::string heading(std::string_view product, std::string_view title, const std::vector<std::string>& facts) {
  std::string out = "<header>\n<p class=\"product\">" + escaped(product) + "</p>\n<h1>" + escaped(title) +
                    "</h1>\n<ul class=\"facts\">";
  for (const std::string& fact : facts) out += "<li>" + fact + "</li>";
  return out + "</ul>\n</header>\n";
}

std::string side_by_side(std::string_view one, std::string_view other) {
  return "<div class=\"pair\">\n" + std::string(one) + std::string(other) + "</div>\n";
}

std::string figure_of(std::string_view svg, std::string_view title, std::string_view caption) {
  return "<figure>\n" + (title.empty() ? "" : "<h3>" + std::string(title) + "</h3>\n") + std::string(svg) +
         "<figcaption>" + std::string(caption) + "</figcaption>\n</figure>\n";
}

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Utf8Letter letter = first_letter_of(text);
    const std::string_view one = text.substr(0, std::max<std::size_t>(letter.bytes, 1));
    text.remove_prefix(one.size());
    if (letter.bytes == 0 || is_control(letter.code)) out += kUnknown;
    else if (one == "&") out += "&amp;";
    else if (one == "<") out += "&lt;";
    else if (one == ">") out += "&gt;";
    else if (one == "\"") out += "&quot;";
    else if (one == "'") out += "&#39;";
    else out += one;
  }
  return out;
}

std::string linked(std::string_view file_name) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._~-";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out;
  for (const char c : file_name) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != std::string_view::npos) out += c;
    else (((out += '%') += kHex[byte >> 4U]) += kHex[byte & 15U]);
  }
  return out;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8U) | (i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k > bytes.size() - i ? '=' : kDigits[(three >> (18 - 6 * k)) & 63U];
  }
  return out;
}

std::string figure(double value, int decimals) {
  if (!std::isfinite(value)) return std::string(kDash);
  std::string out = fixed(value, decimals);
  if (out.front() == '-') out.replace(0, 1, kMinus);
  return out;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "0";
  std::string out = fixed(value, decimals);
  if (out.find('.') == std::string::npos) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

int decimals_for(double sigma) {
  if (!(sigma > 0) || !std::isfinite(sigma)) return 3;
  return std::clamp(1 - int(std::floor(std::log10(sigma))), 0, 7);
}

int decimals_of(double value) {
  if (value > 0 && value < 0.00095) return 4;
  return value < 0.0995 ? 3 : value < 99.95 ? 2 : 0;
}

std::string counted(int count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

std::string sentence(std::string_view reason) {
  std::string out(reason);
  if (out.empty()) return out;
  if (out.front() >= 'a' && out.front() <= 'z') out.front() = char(out.front() - 'a' + 'A');
  if (out.back() != '.') out += '.';
  if (const auto at = out.find("+-"); at != std::string::npos) out.replace(at, 2, "±");
  return out;
}

}  // namespace relievo::pipeline::report
