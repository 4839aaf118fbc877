// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/page.h"

#include "pipeline/report/text.h"

namespace relievo::pipeline::report {

std::string page(std::string_view title, std::string_view more_style, std::string_view body) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>\n";
  out.append(page_style()).append(more_style).append("</style>\n</head>\n<body>\n<main>\n").append(body);
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

}  // namespace relievo::pipeline::report
