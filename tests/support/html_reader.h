// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the part of HTML that a report may be written in, and is strict about it: every element closed in
// order, every attribute quoted and named once, every & an entity. Knows nothing of how the page is made.
#pragma once

#include <cctype>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace relievo::tests {

struct HtmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;  // decoded
};

class HtmlReader {
 public:
  explicit HtmlReader(std::string_view page) : rest_(page) {
    if (!skip("<!DOCTYPE html>\n")) fail("no doctype");
    while (!rest_.empty() && error_.empty()) rest_.front() == '<' ? read_tag() : read_text();
    if (error_.empty() && !open_.empty()) fail("<" + open_.back() + "> stays open");
  }

  const std::string& error() const { return error_; }  // empty: well-formed
  const std::string& text() const { return text_; }    // all of it, decoded, style sheet aside
  const std::vector<HtmlElement>& elements() const { return elements_; }

  std::vector<HtmlElement> with_class(std::string_view name) const {
    std::vector<HtmlElement> found;
    for (const HtmlElement& element : elements_) {
      const auto at = element.attributes.find("class");
      if (at != element.attributes.end() &&
          (" " + at->second + " ").find(" " + std::string(name) + " ") != std::string::npos)
        found.push_back(element);
    }
    return found;
  }

 private:
  void fail(const std::string& what) {
    if (error_.empty()) error_ = what + " before: " + std::string(rest_.substr(0, 60));
  }
  bool skip(std::string_view words) {
    if (!rest_.starts_with(words)) return false;
    rest_.remove_prefix(words.size());
    return true;
  }
  std::string take_until(std::string_view ends) {
    const std::string taken(rest_.substr(0, rest_.find_first_of(ends)));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::string decoded(std::string_view text) {
    static const std::map<std::string, std::string, std::less<>> kEntities = {
        {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"#39", "'"}, {"nbsp", " "}};
    std::string out;
    while (!text.empty()) {
      const std::size_t plain = std::min(text.find('&'), text.size());
      out += text.substr(0, plain);
      text.remove_prefix(plain);
      if (text.empty()) break;
      const std::size_t end = text.find(';');
      const auto entity = kEntities.find(text.substr(1, end == std::string_view::npos ? 0 : end - 1));
      if (entity == kEntities.end()) {
        fail("a bare &: " + std::string(text.substr(0, 20)));
        return out;
      }
      out += entity->second;
      text.remove_prefix(end + 1);
    }
    return out;
  }
  void read_text() {
    const std::string raw = take_until("<");
    if (!open_.empty() && open_.back() == "style") return;
    if (raw.find('>') != std::string::npos) fail("a bare >");
    text_ += decoded(raw);
  }
  void read_tag() {
    if (skip("</")) {
      const std::string name = take_until(">");
      if (!skip(">") || open_.empty() || open_.back() != name) return fail("</" + name + "> closes nothing");
      open_.pop_back();
      return;
    }
    skip("<");
    HtmlElement element;
    element.name = take_until(" />\n");
    if (element.name.empty() || std::isalpha(static_cast<unsigned char>(element.name.front())) == 0)
      return fail("a bare <");
    while (skip(" ")) read_attribute(element);
    const bool closed = skip("/");
    if (!skip(">")) return fail("<" + element.name + " does not end");
    const bool empty = element.name == "meta" || element.name == "br";
    if (!closed && !empty) open_.push_back(element.name);
    elements_.push_back(element);
  }
  void read_attribute(HtmlElement& element) {
    const std::string name = take_until("= />");
    if (!skip("=\"")) return fail("attribute " + name + " is not quoted");
    const std::string value = take_until("\"<");
    if (!skip("\"")) return fail("attribute " + name + " does not end");
    if (!element.attributes.emplace(name, decoded(value)).second) fail("attribute " + name + " twice");
  }

  std::string_view rest_;
  std::string error_;
  std::string text_;
  std::vector<std::string> open_;
  std::vector<HtmlElement> elements_;
};

}  // namespace relievo::tests
