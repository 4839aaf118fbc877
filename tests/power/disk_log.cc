// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/power/disk_log.h"

#include <algorithm>

#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;
using Kind = DiskChange::Kind;

constexpr std::size_t kSector = 512;

int take_in(DiskTree& tree, const fs::path& place) {
  const int number = static_cast<int>(tree.nodes.size());
  tree.nodes.push_back({fs::is_directory(place)});
  if (!fs::is_directory(place)) {
    tree.nodes.back().bytes = read_text(place);
    return number;
  }
  for (const auto& entry : fs::directory_iterator(place)) {
    const int child = take_in(tree, entry.path());
    tree.nodes[static_cast<std::size_t>(number)].names[entry.path().filename().string()] = child;
  }
  return number;
}

void put(std::string& file, std::size_t at, std::string_view bytes) {
  if (file.size() < at + bytes.size()) file.resize(at + bytes.size());
  file.replace(at, bytes.size(), bytes);
}

void apply_names(DiskTree& tree, const DiskChange& change) {
  for (const auto& [folder, name, node] : change.names) {
    auto& names = tree.nodes[static_cast<std::size_t>(folder)].names;
    if (node < 0) names.erase(name);
    else names[name] = node;
  }
}

// All of it.
void apply(DiskTree& tree, const DiskChange& change) {
  if (change.kind == Kind::Names) return apply_names(tree, change);
  auto& bytes = tree.nodes[static_cast<std::size_t>(change.node)].bytes;
  if (change.kind == Kind::Size) bytes.resize(change.at);
  else put(bytes, change.at, change.bytes);
}

// What a cut may do to what is not synced: as many different disks as seeds.
class Damage {
 public:
  explicit Damage(std::uint32_t seed)
      : random_(seed),
        kept_(seed % 8 == 0   ? 0
              : seed % 8 == 1 ? 100
                              : random_() % 101) {
    in_order_ = random_() % 2 == 0;
    junk_ = random_() % 3 == 0 ? 15 : 0;
  }

  void apply_part(DiskTree& tree, const DiskChange& change) {
    if (change.kind == Kind::Names) {
      // A journal of names ends somewhere; a disk without one forgets any.
      names_end_ = names_end_ || (in_order_ && !chance(kept_));
      if (in_order_ ? !names_end_ : chance(kept_)) apply_names(tree, change);
      return;
    }
    auto& file = tree.nodes[static_cast<std::size_t>(change.node)].bytes;
    if (change.kind == Kind::Size) {
      if (chance(kept_)) file.resize(change.at);
      return;
    }
    const std::string_view bytes = change.bytes;
    for (std::size_t from = 0; from < bytes.size();) {
      const std::size_t size = std::min(bytes.size() - from, kSector - (change.at + from) % kSector);
      if (chance(kept_)) put(file, change.at + from, bytes.substr(from, size));
      else if (chance(junk_)) put(file, change.at + from, junk(size));
      from += size;
    }
  }

 private:
  bool chance(unsigned long percent) { return random_() % 100 < percent; }
  std::string junk(std::size_t size) {
    std::string bytes(size, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random_());
    return bytes;
  }
  std::mt19937 random_;
  unsigned long kept_;  // of a hundred
  bool in_order_ = false, names_end_ = false;
  unsigned long junk_ = 0;
};

}  // namespace

DiskTree DiskTree::of(const fs::path& root) {
  DiskTree tree;
  take_in(tree, root);
  return tree;
}

void DiskTree::write(const fs::path& target, int node) const {
  const Node& here = nodes[static_cast<std::size_t>(node)];
  if (!here.folder) {
    write_text(target, here.bytes);
    fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
    return;
  }
  if (node == 0) fs::remove_all(target);
  fs::create_directory(target);
  for (const auto& [name, child] : here.names) write(target / name, child);
}

void CutDisk::sync(int node) {
  std::erase_if(pending_, [&](const DiskChange* change) {
    const bool named =
        std::ranges::any_of(change->names, [&](const auto& name) { return name.folder == node; });
    if (node >= 0 && change->node != node && !named) return false;
    apply(disk_, *change);
    return true;
  });
}

void CutDisk::go_to(std::size_t change) {
  for (; next_ < change; ++next_) {
    const DiskChange& now = log_.changes[next_];
    if (now.kind == Kind::Sync || now.kind == Kind::SyncAll) {
      sync(now.kind == Kind::Sync ? now.node : -1);
    } else if (now.kind != Kind::Acknowledged) {
      // A new file has a place before it has a name.
      for (const auto& name : now.names)
        for (int node = static_cast<int>(disk_.nodes.size()); node <= name.node; ++node)
          disk_.nodes.push_back({now.at != 0});
      pending_.push_back(&now);
    }
  }
}

DiskTree CutDisk::cut(std::uint32_t seed) const {
  DiskTree disk = disk_;
  Damage damage(seed);
  for (const DiskChange* change : pending_) damage.apply_part(disk, *change);
  return disk;
}

DiskTree CutDisk::killed() const {
  DiskTree disk = disk_;
  for (const DiskChange* change : pending_) apply(disk, *change);
  if (next_ < log_.changes.size() && log_.changes[next_].kind == Kind::Write) {
    DiskChange half = log_.changes[next_];
    half.bytes.resize(half.bytes.size() / 2);
    apply(disk, half);
  }
  return disk;
}

}  // namespace relievo::test
