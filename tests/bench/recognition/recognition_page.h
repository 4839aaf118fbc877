// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recognition proof as one page of HTML that needs nothing beside it: figures, the distributions of same
// and different persons, the error rates over the threshold, and both by maker and by how far the head was
// turned. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/recognition/population.h"
#include "tests/bench/recognition/scores.h"

namespace relievo::bench {

struct Failure {
  std::string visit, why;  // could not be reconstructed
};

struct Proof {
  std::vector<Person> people;
  std::vector<Score> scores;
  std::vector<Failure> failures;
};

// Scores of one group of probes: against everybody, and only against those of the same maker.
struct Group {
  std::string name;
  Verdict verdict;
};
std::vector<Group> groups_of(const Proof& proof);

std::string page_of(const Proof& proof);

}  // namespace relievo::bench
