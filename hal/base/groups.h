// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups: which members belong to each of many groups, one list after the other (a counting sort): triangles
// around vertices, points in cells. Members keep the order they were added in. Throws std::bad_alloc when the
// memory is used up. Thread: any, once sorted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace relievo {

class Groups {
 public:
  explicit Groups(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : first_(1, 0U, memory), members_(memory) {}

  // `each` is given add(group, member) and calls it for every member; it is called twice and does the same
  // both times.
  template <typename Each>
  void sort(std::size_t groups, Each&& each) {
    first_.assign(groups + 1, 0U);
    each([this](std::size_t group, std::uint32_t) { ++first_[group + 1]; });
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    members_.resize(first_.back());
    each([this](std::size_t group, std::uint32_t member) { members_[first_[group]++] = member; });
    // Filling moved each start to its end, which is the next one's start.
    for (std::size_t k = groups; k > 0; --k) first_[k] = first_[k - 1];
    first_[0] = 0;
  }

  std::size_t size() const { return first_.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return {members_.data() + first_[group], first_[group + 1] - first_[group]};
  }
  std::size_t members() const { return members_.size(); }

 private:
  std::pmr::vector<std::uint32_t> first_, members_;  // of group k: members_[first_[k] .. first_[k + 1])
};

}  // namespace relievo
