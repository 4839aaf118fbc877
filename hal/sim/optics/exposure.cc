// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/optics/exposure.h"

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

constexpr int kBands = 60;
constexpr int kFineSide = 3;  // samples a side where bodies meet

struct Cell {
  std::int32_t body = -1;
  float distance_mm = 0;
  bool fine = false;
};

std::size_t index_of(int width, int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); }

void store(LightPicture& out, std::size_t i, Vec3 light) {
  out.rgb[3 * i] = float(light.x), out.rgb[3 * i + 1] = float(light.y), out.rgb[3 * i + 2] = float(light.z);
}

bool differs(const Cell& a, const Cell& b) {
  return a.body != b.body || a.fine || b.fine || std::abs(a.distance_mm - b.distance_mm) > 2.5F;
}

Vec3 many_samples(const Scene& scene, const SimView& view, Vec3 eye, int x, int y) {
  Vec3 sum;
  for (int k = 0; k < kFineSide * kFineSide; ++k) {
    const std::uint32_t h = hash_cell(x, y, k, 3);
    const double u = (k % kFineSide + unit_from_hash(h)) / kFineSide - 0.5,
                 v = (k / kFineSide + unit_from_hash(h * 2654435761U)) / kFineSide - 0.5;
    sum += scene.look(eye, view.ray(x + u, y + v)).light;
  }
  return sum * (1.0 / (kFineSide * kFineSide));
}

// Separable; the edges repeat.
void blur(LightPicture& picture, double deviation_px, ThreadPool& pool) {
  if (deviation_px < 0.05) return;
  const int reach = std::max(1, int(std::ceil(3 * deviation_px)));
  std::vector<float> weight(std::size_t(2 * reach + 1));
  float total = 0;
  for (int i = -reach; i <= reach; ++i)
    total += weight[std::size_t(i + reach)] = float(std::exp(-0.5 * i * i / (deviation_px * deviation_px)));
  for (float& w : weight) w /= total;
  const int w = picture.width_px, h = picture.height_px;
  for (const bool across : {true, false}) {
    std::vector<float> out(picture.rgb.size());
    pool.for_each(h, kBands, [&](int y) {
      for (int x = 0; x < w; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          float sum = 0;
          for (int k = -reach; k <= reach; ++k) {
            const std::size_t from = across ? index_of(w, std::clamp(x + k, 0, w - 1), y)
                                            : index_of(w, x, std::clamp(y + k, 0, h - 1));
            sum += weight[std::size_t(k + reach)] * picture.rgb[3 * from + c];
          }
          out[3 * index_of(w, x, y) + c] = sum;
        }
    });
    picture.rgb.swap(out);
  }
}

std::uint8_t to_byte_by_power(double v) { return std::uint8_t(std::lround(255 * srgb(clamp01(v)))); }

// to_byte_by_power() without a power a value: the least light of every byte, found once by bisection.
class GammaTable {
 public:
  GammaTable() {
    for (std::size_t byte = 1; byte < least_.size(); ++byte) {
      double below = least_[byte - 1], reached = 1;
      for (;;) {
        const double middle = 0.5 * (below + reached);
        if (middle <= below || middle >= reached) break;
        (to_byte_by_power(middle) >= byte ? reached : below) = middle;
      }
      least_[byte] = reached;
    }
    for (std::size_t i = 0; i < near_.size(); ++i) near_[i] = to_byte_by_power(double(i) / kCells);
  }
  std::uint8_t operator()(double v) const {
    if (v >= 1) return 255;
    std::uint8_t byte = near_[std::size_t(std::max(v, 0.0) * kCells)];
    while (byte < 255 && v >= least_[byte + 1U]) ++byte;
    return byte;
  }

 private:
  static constexpr int kCells = 4096;
  std::array<double, 256> least_{};
  std::array<std::uint8_t, kCells> near_{};  // of the darkest light of every cell
};

std::uint8_t to_byte(double v, bool gamma) {
  static const GammaTable table;
  return gamma ? table(v) : std::uint8_t(std::lround(255 * clamp01(v)));
}

}  // namespace

double srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

LightPicture expose(const Scene& scene, const SimView& view, const SensorOptions& sensor, ThreadPool& pool) {
  LightPicture out{view.width_px, view.height_px, {}};
  const std::size_t count = std::size_t(view.width_px) * std::size_t(view.height_px);
  out.rgb.resize(3 * count);
  std::vector<Cell> cells(count);
  const Vec3 eye = view.centre();
  pool.for_each(view.height_px, kBands, [&](int y) {
    for (int x = 0; x < view.width_px; ++x) {
      const std::size_t i = index_of(view.width_px, x, y);
      const RayHit hit = scene.look(eye, view.ray(x, y));
      store(out, i, hit.light);
      cells[i] = {hit.body, float(hit.distance_mm), hit.fine};
    }
  });
  pool.for_each(view.height_px, kBands, [&](int y) {
    for (int x = 0; x < view.width_px; ++x) {
      const std::size_t i = index_of(view.width_px, x, y);
      bool edge = cells[i].fine;
      for (int k = 0; k < 4 && !edge; ++k) {
        const int u = std::clamp(x + (k == 0) - (k == 1), 0, view.width_px - 1),
                  v = std::clamp(y + (k == 2) - (k == 3), 0, view.height_px - 1);
        edge = differs(cells[i], cells[index_of(view.width_px, u, v)]);
      }
      if (edge) store(out, i, many_samples(scene, view, eye, x, y));
    }
  });
  // Defocus is a matter of the lens, so it scales with the pixels of a smaller picture.
  blur(out, sensor.defocus_px, pool);
  return out;
}

Picture read_sensor(const LightPicture& light, const SensorOptions& s, std::uint64_t noise_seed) {
  // Hashed first: neighbouring seeds of Random are neighbouring places of one sequence, and the next
  // frame's noise would be this one's, a channel further on.
  Random random(Random(noise_seed).next());
  const std::size_t count = light.rgb.size() / 3;
  Picture out{std::vector<std::byte>(s.grey ? count : 3 * count), light.width_px, light.height_px,
              s.grey ? PixelFormat::Grey8 : PixelFormat::Rgb8};
  const auto read = [&](double v) {
    const double electrons = std::max(v * s.exposure, 0.0) * s.full_well_electrons;
    const double deviation = s.noise * std::sqrt(electrons + s.read_noise_electrons * s.read_noise_electrons);
    return to_byte((electrons + deviation * (s.noise > 0 ? random.normal() : 0)) / s.full_well_electrons,
                   s.gamma);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (s.grey) {
      out.bytes[i] = std::byte{read(0.3 * double(light.rgb[3 * i]) + 0.59 * double(light.rgb[3 * i + 1]) +
                                    0.11 * double(light.rgb[3 * i + 2]))};
    } else {
      for (std::size_t c = 0; c < 3; ++c)
        out.bytes[3 * i + c] = std::byte{read(double(light.rgb[3 * i + c]))};
    }
  }
  return out;
}

}  // namespace relievo::hal::sim
