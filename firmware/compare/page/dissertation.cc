// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/page/dissertation.h"

namespace relievo::firmware::compare {

std::vector<Figure> figures_of(const Dissertation& d) {
  const auto runs = [](const Comparison& c, std::initializer_list<std::size_t> which) {
    std::vector<const Run*> some;
    for (const std::size_t i : which) some.push_back(&c.runs[i]);
    return some;
  };
  std::vector<Figure> all{{6, "SSD and ZMNCC", d.rules, runs(d.rules, {0, 1, d.rules.runs.size() - 1})}};
  for (std::size_t i = 0; i < kDissertationRules.size(); ++i)
    all.push_back({static_cast<int>(7 + i), "the " + std::string(kDissertationRules[i]) + " constraint",
                   d.rules, runs(d.rules, {2 + i})});
  all.push_back({17, "the fully automatic face", d.face, runs(d.face, {0, 1, 2, 3})});
  return all;
}

}  // namespace relievo::firmware::compare
