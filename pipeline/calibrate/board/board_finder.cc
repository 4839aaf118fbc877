// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/board_finder.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "hal/base/statistics.h"
#include "pipeline/calibrate/board/corner_refiner.h"
#include "pipeline/calibrate/board/lattice.h"
#include "pipeline/calibrate/board/saddle_finder.h"

namespace relievo::pipeline {
namespace {

constexpr int kLeastSidePx = 32;
constexpr std::size_t kMostSaddles = 6000;  // of a picture: the largest board has 3600
constexpr std::size_t kMostLattices = 12;   // that are looked into
constexpr int kLeastGroup = 6;              // crossings
constexpr double kWholeShare = 0.6;         // of a chessboard's corners that must be seen, and
constexpr double kLineShare = 0.3;          // of those of each outer row and column
constexpr int kLeastCorners = 8;            // of a ChArUco board
constexpr double kStrayFactor = 6;          // times the usual distance from where the neighbours say
constexpr double kStrayShare = 0.15;        // of a step, that a crossing may be off its neighbours' lattice
constexpr double kStrayPx = 0.3;            // and that a refined corner may
constexpr double kPlainShare = 0.5;         // of a chessboard's square beside an edge: all of it

double distance(const Vec2d& a, const Vec2d& b) { return std::hypot(a.x - b.x, a.y - b.y); }

int neighbours(const Lattice& lattice, int column, int row) {
  return (lattice.seen(column - 1, row) ? 1 : 0) + (lattice.seen(column + 1, row) ? 1 : 0) +
         (lattice.seen(column, row - 1) ? 1 : 0) + (lattice.seen(column, row + 1) ? 1 : 0);
}

// Moves every node to the corner's exact place; forgets those that are no trustworthy corners.
void refine_nodes(CornerRefiner& refiner, Lattice& lattice) {
  const Lattice before = lattice;  // predictions from places of one kind
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column) {
      if (!before.seen(column, row)) continue;
      auto guess = predict(before, column, row);
      if (!guess) {
        lattice.node(column, row).swing = 0;
        continue;
      }
      guess->at = before.node(column, row).at;
      lattice.node(column, row) = refiner.refine(*guess);
    }
}

// Looks for every unseen node beside seen ones, over and over, until nothing more is found.
void fill_gaps(CornerRefiner& refiner, Lattice& lattice) {
  // How many neighbours were seen when a node was last looked for in vain: with more it is worth another
  // look.
  std::vector<int> tried(std::size_t(lattice.columns()) * std::size_t(lattice.rows()));
  for (bool grown = true; grown;) {
    grown = false;
    for (int row = 0; row < lattice.rows(); ++row)
      for (int column = 0; column < lattice.columns(); ++column) {
        if (lattice.seen(column, row)) continue;
        int& before = tried[lattice.index(column, row)];
        const int around = neighbours(lattice, column, row);
        if (around <= before) continue;
        before = around;
        const auto guess = predict(lattice, column, row);
        if (!guess) continue;
        lattice.node(column, row) = refiner.refine(*guess);
        grown = grown || lattice.seen(column, row);
      }
  }
}

// Forgets nodes that are not where their neighbours say: off by more than `least_px` and by far more
// than is usual here.
void drop_strays(Lattice& lattice, double least_px) {
  std::vector<double> off;
  std::vector<double> usual;
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column) {
      const auto guess = lattice.seen(column, row) ? predict(lattice, column, row) : std::nullopt;
      off.push_back(guess ? distance(guess->at, lattice.node(column, row).at) : 0);
      if (guess) usual.push_back(off.back());
    }
  if (usual.empty()) return;
  const double limit = std::max(least_px, kStrayFactor * median(usual));
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column)
      if (off[lattice.index(column, row)] > limit) lattice.node(column, row).swing = 0;
}

// The usual distance between neighbours, px.
double step_px(const Lattice& lattice) {
  double sum = 0;
  int count = 0;
  for (int row = 0; row < lattice.rows(); ++row)
    for (int column = 0; column < lattice.columns(); ++column)
      for (const auto& [right, down] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (!lattice.seen(column, row) || !lattice.seen(column + right, row + down)) continue;
        sum += distance(lattice.node(column, row).at, lattice.node(column + right, row + down).at);
        ++count;
      }
  return count > 0 ? sum / count : 0;
}

// The narrowest frame around the lattice whose outer rows and columns are no accident.
Lattice framed(const Lattice& lattice) {
  int left = 0, top = 0, columns = lattice.columns(), rows = lattice.rows();
  const auto part = [&] { return lattice.cut(left, top, columns, rows); };
  for (bool cut = true; cut && columns > 2 && rows > 2;) {
    const Lattice now = part();
    cut = true;
    if (now.count_row(0) < kLineShare * columns) ++top, --rows;
    else if (now.count_row(rows - 1) < kLineShare * columns) --rows;
    else if (now.count_column(0) < kLineShare * rows) ++left, --columns;
    else if (now.count_column(columns - 1) < kLineShare * rows) --columns;
    else cut = false;
  }
  return part();
}

bool fits(const Lattice& lattice, const BoardPattern& pattern) {
  const bool as_it_is = lattice.columns() == pattern.columns && lattice.rows() == pattern.rows;
  const bool turned = lattice.columns() == pattern.rows && lattice.rows() == pattern.columns;
  return (as_it_is || turned) && lattice.count() >= kWholeShare * pattern.corners();
}

// Every way up that the colours allow; of those the one whose rows run most to the right.
Lattice upright(const Lattice& lattice, const BoardPattern& pattern) {
  Lattice best = lattice, turned = lattice;
  std::pair most{false, -1e300};
  for (int turns = 0; turns < 4; ++turns, turned = turned.quarter_turned()) {
    if (turned.columns() != pattern.columns || turned.rows() != pattern.rows) continue;
    double run = 0;
    for (int row = 0; row < turned.rows(); ++row)
      for (int column = 0; column + 1 < turned.columns(); ++column)
        if (turned.seen(column, row) && turned.seen(column + 1, row))
          run += turned.node(column + 1, row).at.x - turned.node(column, row).at.x;
    const std::pair here(turned.dark(-1, -1), run);
    if (here < most) continue;
    best = turned;
    most = here;
  }
  return best;
}

class Search {
 public:
  Search(const ImageView& picture, const BoardPattern& pattern) : pattern_(pattern), pyramid_(picture) {}

  // In a reduced picture first: it has a board's corners, less noise and blur, and few pixels. What is
  // found of a ChArUco board is asked of the next larger one, too, as long as that knows more.
  std::optional<Lattice> run() {
    std::optional<Lattice> best;
    for (int level = pyramid_.levels() - 1; level >= 0; --level) {
      auto found = pattern_.kind == BoardKind::Chessboard ? chessboard(level) : charuco(level);
      const bool more = found && (!best || found->count() > best->count());
      if (best && !more) break;
      if (more) best = std::move(found);
      if (best && (pattern_.kind == BoardKind::Chessboard || best->count() == pattern_.corners())) break;
    }
    return best;
  }

 private:
  std::vector<Lattice> groups(int level, int least) const {
    const SmoothPicture smooth(pyramid_.level(level));
    auto lattices = find_lattices(smooth, find_saddles(smooth, kMostSaddles), least);
    if (lattices.size() > kMostLattices) lattices.erase(lattices.begin() + kMostLattices, lattices.end());
    return lattices;
  }

  std::optional<Lattice> chessboard(int level) {
    CornerRefiner refiner(pyramid_.level(level), clear_share_);
    const int least = std::min(pattern_.columns, pattern_.rows);
    const int most = std::max(pattern_.columns, pattern_.rows);
    for (const Lattice& group : groups(level, std::max(kLeastGroup, pattern_.corners() / 4))) {
      if (std::max(group.columns(), group.rows()) > most + 2 ||
          std::min(group.columns(), group.rows()) > least + 2)
        continue;
      // Room for what the search has overlooked, one line more than the board has: a larger board is none.
      const int wide = std::max(most + 1 - group.columns(), 1), high = std::max(most + 1 - group.rows(), 1);
      Lattice lattice = group.cut(-wide, -high, group.columns() + 2 * wide, group.rows() + 2 * high);
      drop_strays(lattice, kStrayShare * step_px(lattice));
      fill_gaps(refiner, lattice);
      lattice = framed(lattice);
      if (!fits(lattice, pattern_)) continue;
      lattice.scale(1 << level);
      refine_nodes(full_size_, lattice);
      fill_gaps(full_size_, lattice);
      drop_strays(lattice, kStrayPx);
      if (fits(framed(lattice), pattern_)) return upright(lattice, pattern_);
    }
    return std::nullopt;
  }

  std::optional<Lattice> charuco(int level) {
    if (markers_.empty()) markers_ = marker_modules(pattern_.marker_bits, pattern_.markers());
    std::optional<Lattice> board;
    for (Lattice& group : groups(level, kLeastGroup)) {
      drop_strays(group, kStrayShare * step_px(group));
      group.scale(1 << level);
      refine_nodes(full_size_, group);
      const auto part = place_on_board(pyramid_.level(0), group, pattern_, markers_);
      if (!part) continue;
      if (!board) board = *part;
      for (int row = 0; row < pattern_.rows; ++row)
        for (int column = 0; column < pattern_.columns; ++column)
          if (!board->seen(column, row)) board->node(column, row) = part->node(column, row);
    }
    if (!board) return std::nullopt;
    fill_gaps(full_size_, *board);
    drop_strays(*board, kStrayPx);
    return enough(*board) ? board : std::nullopt;
  }

  bool enough(const Lattice& lattice) const {
    int rows = 0;
    int columns = 0;
    for (int row = 0; row < lattice.rows(); ++row) rows += lattice.count_row(row) > 1 ? 1 : 0;
    for (int column = 0; column < lattice.columns(); ++column)
      columns += lattice.count_column(column) > 1 ? 1 : 0;
    return lattice.count() >= kLeastCorners && rows >= 2 && columns >= 2;
  }

  const BoardPattern& pattern_;
  GreyPyramid pyramid_;
  double clear_share_{pattern_.kind == BoardKind::Chessboard
                          ? kPlainShare
                          : 0.5 - 0.5 * pattern_.marker_side_mm() / pattern_.square_mm};
  CornerRefiner full_size_{pyramid_.level(0), clear_share_};
  std::vector<std::uint64_t> markers_;
};

constexpr int kMostMarkers = 1000;  // of a dictionary

std::size_t index(const BoardPattern& pattern, int column, int row) {
  return std::size_t(row) * std::size_t(pattern.columns) + std::size_t(column);
}

BoardCorners half_turned(const BoardCorners& corners) { return {corners.rbegin(), corners.rend()}; }

// Of a board with as many columns as rows.
BoardCorners quarter_turned(const BoardCorners& corners, const BoardPattern& pattern) {
  BoardCorners out;
  for (int row = 0; row < pattern.rows; ++row)
    for (int column = 0; column < pattern.columns; ++column)
      out.push_back(corners[index(pattern, row, pattern.rows - 1 - column)]);
  return out;
}

// The sum of the steps along all rows.
Vec2d run_of(const BoardCorners& corners, const BoardPattern& pattern) {
  Vec2d sum;
  for (int row = 0; row < pattern.rows; ++row)
    for (int column = 0; column + 1 < pattern.columns; ++column) {
      const Vec2d& a = corners[index(pattern, column, row)];
      const Vec2d& b = corners[index(pattern, column + 1, row)];
      if (seen(a) && seen(b)) sum = {sum.x + b.x - a.x, sum.y + b.y - a.y};
    }
  return sum;
}

// A marker with its black border, each row of modules in as few pieces as there are runs.
void draw_marker(std::uint64_t white, int bits, double x_mm, double y_mm, double side_mm,
                 std::vector<BlackArea>& out) {
  const int modules = bits + 2;
  const double module_mm = side_mm / modules;
  const auto black = [&](int column, int row) {
    if (column == 0 || row == 0 || column == modules - 1 || row == modules - 1) return true;
    return (white >> ((row - 1) * bits + column - 1) & 1) == 0;
  };
  for (int row = 0; row < modules; ++row)
    for (int column = 0; column < modules;) {
      if (!black(column, row)) {
        ++column;
        continue;
      }
      const int first = column;
      while (column < modules && black(column, row)) ++column;
      out.push_back(
          {x_mm + first * module_mm, y_mm + row * module_mm, (column - first) * module_mm, module_mm});
    }
}

}  // namespace

Result<void> BoardPattern::check() const {
  if (columns < 3 || rows < 3 || columns > 60 || rows > 60)
    return invalid("a board has 3 to 60 inner corners a side, as in 10x7").at("--corners");
  if (!(square_mm >= 0.1 && square_mm <= 1000))
    return invalid("a square must measure 0.1 to 1000 mm").at("--square-mm");
  if (kind == BoardKind::Chessboard) return {};
  if (!(marker_side_mm() >= 0.3 * square_mm && marker_side_mm() <= 0.9 * square_mm))
    return invalid("a marker measures 0.3 to 0.9 of its square").at("--marker-mm");
  if (marker_bits < 4 || marker_bits > 7)
    return invalid("a marker has 4 to 7 bits a side").at("--marker-bits");
  if (markers() > kMostMarkers)
    return invalid("a ChArUco board has at most 1000 markers; choose fewer corners").at("--corners");
  return {};
}

void pair_order(const BoardCorners& left, BoardCorners& right, const BoardPattern& pattern) {
  if (pattern.kind == BoardKind::Charuco) return;
  const Vec2d a = run_of(left, pattern);
  const auto agreement = [&](const BoardCorners& corners) {
    const Vec2d b = run_of(corners, pattern);
    return a.x * b.x + a.y * b.y;
  };
  const auto offer = [&](BoardCorners turned) {
    if (agreement(turned) > agreement(right)) right = std::move(turned);
  };
  offer(half_turned(right));
  if (pattern.columns != pattern.rows) return;
  offer(quarter_turned(right, pattern));
  offer(half_turned(quarter_turned(right, pattern)));
}

Result<std::vector<BlackArea>> draw_board(const BoardPattern& pattern) try {
  RELIEVO_TRY(pattern.check());
  const bool charuco = pattern.kind == BoardKind::Charuco;
  const auto markers =
      charuco ? marker_modules(pattern.marker_bits, pattern.markers()) : std::vector<std::uint64_t>();
  const double side = pattern.square_mm;
  const double rim = (side - pattern.marker_side_mm()) / 2;
  std::vector<BlackArea> out;
  std::size_t marker = 0;
  for (int row = 0; row <= pattern.rows; ++row)
    for (int column = 0; column <= pattern.columns; ++column) {
      if ((column + row) % 2 == 0) out.push_back({column * side, row * side, side, side});
      else if (charuco)
        draw_marker(markers[marker++], pattern.marker_bits, column * side + rim, row * side + rim,
                    pattern.marker_side_mm(), out);
    }
  return out;
} catch (const std::exception&) {
  return Error{Errc::LibraryFailed, "OpenCV's dictionary of markers cannot be read"};
}

Result<BoardCorners> find_board(const ImageView& picture, const BoardPattern& pattern) {
  RELIEVO_TRY(pattern.check());
  if (picture.empty()) return invalid("there is no picture to look for a board in");
  if (picture.width_px < kLeastSidePx || picture.height_px < kLeastSidePx)
    return Error{Errc::NotFound, "no board found"};
  try {
    const auto lattice = Search(picture, pattern).run();
    if (!lattice) return Error{Errc::NotFound, "no board found"};
    BoardCorners corners;
    for (int row = 0; row < lattice->rows(); ++row)
      for (int column = 0; column < lattice->columns(); ++column)
        corners.push_back(lattice->seen(column, row) ? lattice->node(column, row).at
                                                     : Vec2d{std::nan(""), std::nan("")});
    return corners;
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "there is not enough memory to look for a board"};
  } catch (const std::exception&) {
    return Error{Errc::LibraryFailed, "the search for the board failed in OpenCV"};
  }
}

Result<BoardCorners> look_for_board(const ImageView& picture, const BoardPattern& pattern) {
  auto corners = find_board(picture, pattern);
  return corners || corners.error().code != Errc::NotFound ? corners : BoardCorners{};
}

}  // namespace relievo::pipeline
