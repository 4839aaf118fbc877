// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The choice of algorithms, by name, and the one place that makes them. A choice is text, as on the
// command line (`--set matcher=refined --set refined.bending=0.3`), in a TOML file and in the store.
// Keys: preprocessor, selector, matcher, constraints (names joined by '+', or none), triangulator, outliers,
// mesher, completion, relief, texturer, fuser; and NAME.OPTION for every option of every algorithm.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/reconstruct/face_crop.h"
#include "pipeline/relief/relief_check.h"

namespace relievo::pipeline {

struct HeadFuser;

class AlgorithmSet {
 public:
  // Errors: NotFound (no such key or algorithm), InvalidInput (not a number, out of range, an algorithm named
  // twice, a text that to_text() could not keep); the error's place names the key and what would be possible.
  Result<void> set(std::string_view key, std::string_view value);
  // The value set, or the default.
  std::string get(std::string_view key) const;
  // Every choice, sorted, one "key = value" a line: for reports and the store.
  std::string to_text() const;
  // Such a text. Errors: those of set(); InvalidInput for a line that is no "key = value". Where `unknown` is
  // given, it gets the lines that have errors, and the others hold.
  static Result<AlgorithmSet> from_text(std::string_view text, std::vector<std::string>* unknown = nullptr);
  // What is in the files that options name, by the option's key, as far as they were read. Setting the option
  // forgets it. It is no part of to_text().
  using Texts = std::map<std::string, std::shared_ptr<const std::string>, std::less<>>;
  const Texts& texts() const { return texts_; }
  void keep_text(std::string_view key, std::string text);

 private:
  friend struct OptionReader;
  std::map<std::string, std::string, std::less<>> chosen_;
  Texts texts_;
};

struct AlgorithmDescription {
  const char* name = "";
  const char* sentence = "";  // what it is
  const char* source = "";    // author and year, or "own"
  // A selector's keypoints lie on a lattice; a matcher's matches, where its keypoints do; a mesher joins
  // neighbours of one.
  bool lattice = false;
};

// What may be chosen: for help texts, the technician's page and the documentation.
struct OptionDescription {
  std::string key;    // "refined.bending", or a kind: "matcher"
  std::string value;  // the default
  std::string sentence;
  std::vector<std::string> names = {};  // of a kind, or an option chosen by name: what it may be
  std::vector<AlgorithmDescription> algorithms = {};  // of a kind: what each of `names` is
  OptionRange range = {};                             // of an option
  bool text = false;                                  // any text
  bool several = false;                               // of a kind: names may be joined by '+'
  std::string kind = {};                              // of an option: the kind it belongs to
  bool file = false;                                  // of an option: the path of a text file

  bool is_option() const { return !kind.empty(); }
};
std::vector<OptionDescription> describe_algorithms();

// Said before the first picture is looked at, not after minutes of matching. Errors: InvalidInput (a mesher
// for lattices with scattered matches).
Result<void> check_neighbours(const AlgorithmSet& set);

// What a set chooses, made.
struct Algorithms {
  Preprocessor preprocessor;  // empty: the grey values stay
  KeypointSelector selector;
  Matcher matcher;
  std::vector<MatchConstraint> constraints;
  Triangulator triangulator;
  FaceCropOptions crop;
  OutlierFilter outliers;  // empty: every point is kept
  Mesher mesher;
  Completion completion;
  std::optional<ReliefOptions> relief;  // none: measured, never refused
  Texturer texturer;
};

// Errors: InvalidInput where the options do not fit together.
Result<Algorithms> make_algorithms(const AlgorithmSet& set);
Result<HeadFuser> make_head_fuser(const AlgorithmSet& set);  // pipeline/fuse/head_fuser.h

}  // namespace relievo::pipeline
