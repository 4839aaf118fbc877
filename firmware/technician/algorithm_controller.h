// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// AlgorithmController: every algorithm there is, the set that is chosen, and the option that is being edited.
// What is typed is checked by AlgorithmSet alone: what it refuses stays as it was, and view() says why.
//
//   kind --choose_name()--> name --edit()--> option --type() ... use()--> set()
//
// Indices that do not exist change nothing. Thread: main. Errors: none.
#pragma once

#include <string>
#include <vector>

#include "pipeline/algorithms.h"
#include "ui/technician/technician_view.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

class AlgorithmController {
 public:
  AlgorithmController();
  void begin(const pipeline::AlgorithmSet& set);
  // False: that is nothing of the algorithms'.
  bool act(const ui::TechnicianRequest& request);
  const pipeline::AlgorithmSet& set() const { return set_; }
  // Until the next change.
  ui::TechnicianChoice view() const;

 private:
  bool act_alone(ui::TechnicianAct act);
  void rebuild();
  void choose_name(std::size_t index);
  void edit(std::size_t index);
  void type(char letter);
  void use(const std::string& value);

  std::vector<pipeline::OptionDescription> all_;
  pipeline::AlgorithmSet set_;
  std::size_t kind_ = 0;
  std::size_t edited_ = 0;  // index into options_, if any
  bool editing_ = false;
  std::string typed_, refused_;
  std::vector<const pipeline::OptionDescription*> kinds_, shown_;  // of all_
  std::vector<std::string> kind_values_, option_values_;
  std::vector<ui::TechnicianKind> kind_views_;
  std::vector<ui::TechnicianName> names_;
  std::vector<ui::TechnicianOption> options_;
};

// Where the store keeps the set that visitors are measured with, as AlgorithmSet::to_text().
inline constexpr const char* kAlgorithmsSetting = "algorithms";

}  // namespace relievo::firmware
