// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "pipeline/model/seam_split.h"
#include "storage/byte_order.h"
#include "storage/export/format/export_mesh.h"
#include "storage/model_blob.h"

// Written by hand, not by Debian's tinygltf: its JSON library aborts the process when memory runs out.
// The numbers of the format: glTF 2.0 specification, sections 3.6 (accessors) and 4 (GLB).
namespace relievo::storage {
namespace {

enum ComponentType : int { kUint = 5125, kFloat = 5126 };
enum Target : int { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };

// Puts together the binary chunk, and the JSON of its views and accessors as it grows.
class Buffer {
 public:
  int add_view(std::span<const std::byte> bytes, Target target) {
    data_.resize((data_.size() + 3) / 4 * 4);
    views_ += views_.empty() ? "" : ",";
    views_ += "{\"buffer\":0,\"byteOffset\":" + number_text(data_.size()) +
              ",\"byteLength\":" + number_text(bytes.size());
    if (target != kNoTarget) views_ += ",\"target\":" + number_text(int(target));
    views_ += "}";
    data_.insert(data_.end(), bytes.begin(), bytes.end());
    return view_count_++;
  }

  // Floats of the vertices, or indices. `components` numbers make one element: SCALAR, VEC2 or VEC3.
  template <typename T>
  int add_array(const std::vector<T>& values, std::size_t components, const std::string& box = {}) {
    constexpr bool kOfVertices = std::is_floating_point_v<T>;
    const int view = add_view(std::as_bytes(std::span(values)), kOfVertices ? kVertices : kIndices);
    constexpr const char* kNames[] = {"", "SCALAR", "VEC2", "VEC3"};
    accessors_ += accessors_.empty() ? "" : ",";
    accessors_ += "{\"bufferView\":" + number_text(view) +
                  ",\"componentType\":" + number_text(int(kOfVertices ? kFloat : kUint)) +
                  ",\"count\":" + number_text(values.size() / components) + ",\"type\":\"" +
                  kNames[components] + "\"" + box + "}";
    return accessor_count_++;
  }
  // The format wants to know the box that positions lie in.
  int add_positions(const std::vector<float>& values) {
    std::string low, high;
    for (std::size_t c = 0; c < 3; ++c) {
      float least = values[c], most = values[c];
      for (std::size_t i = c; i < values.size(); i += 3) {
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
      }
      low += (c == 0 ? "" : ",") + number_text(least);
      high += (c == 0 ? "" : ",") + number_text(most);
    }
    return add_array(values, 3, ",\"min\":[" + low + "],\"max\":[" + high + "]");
  }

  const std::vector<std::byte>& data() const { return data_; }
  std::string json() const {
    return "\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
           "],\"buffers\":[{\"byteLength\":" + number_text(data_.size()) + "}]";
  }

 private:
  std::vector<std::byte> data_;
  std::string views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

// glTF's colours of vertices are linear light, ours are coded as sRGB (IEC 61966-2-1).
float linear(std::uint8_t coded) {
  const float value = float(coded) / 255.0f;
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

struct Arrays {
  std::vector<float> positions, normals, uvs, colours, sigmas, measured;
};

Arrays arrays_of(const ExportMesh& mesh, const pipeline::SeamSplit& split) {
  const auto& source = mesh.model.mesh;
  const float turn = mesh.frame == ExportFrame::Head ? 1.0f : -1.0f;
  Arrays out;
  out.positions.reserve(split.entries.size() * 3);
  out.normals.reserve(split.entries.size() * 3);
  for (const auto& [vertex, uv] : split.entries) {
    const auto& at = mesh.vertices_mm[vertex];
    const auto& normal = mesh.normals[vertex];
    out.positions.insert(out.positions.end(), {at.x / 1000.0f, turn * at.y / 1000.0f, turn * at.z / 1000.0f});
    out.normals.insert(out.normals.end(), {normal.x, turn * normal.y, turn * normal.z});
    if (mesh.textured()) {
      out.uvs.insert(out.uvs.end(), {uv.x, uv.y});
    } else {
      for (const std::uint8_t c : mesh.colours[vertex]) out.colours.push_back(linear(c));
    }
    if (!source.sigma_mm.empty())
      out.sigmas.push_back(std::isfinite(source.sigma_mm[vertex]) ? source.sigma_mm[vertex] : 0.0f);
    if (!source.measured.empty()) out.measured.push_back(source.measured[vertex] != 0 ? 1.0f : 0.0f);
  }
  return out;
}

// The JSON of the one mesh.
std::string add_mesh(Buffer& to, const ExportMesh& mesh) {
  const pipeline::SeamSplit split = pipeline::split_at_seams(mesh.model.mesh, mesh.model.texture.uv);
  const Arrays arrays = arrays_of(mesh, split);
  std::string attributes = "\"POSITION\":" + number_text(to.add_positions(arrays.positions));
  const auto add = [&](const char* name, const std::vector<float>& values, std::size_t components) {
    if (!values.empty())
      attributes += std::string(",\"") + name + "\":" + number_text(to.add_array(values, components));
  };
  add("NORMAL", arrays.normals, 3);
  add("TEXCOORD_0", arrays.uvs, 2);
  add("COLOR_0", arrays.colours, 3);
  add("_SIGMA_MM", arrays.sigmas, 1);
  add("_MEASURED", arrays.measured, 1);
  std::vector<std::uint32_t> indices;
  indices.reserve(split.triangles.size() * 3);
  for (const auto& triangle : split.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  return "\"meshes\":[{\"name\":\"face\",\"primitives\":[{\"attributes\":{" + attributes +
         "},\"indices\":" + number_text(to.add_array(indices, 1)) + ",\"material\":0,\"mode\":4}]}],";
}

// Double-sided: a surface of a face is open at its edge. Not metal, not shiny.
std::string add_material(Buffer& to, std::span<const std::byte> png) {
  std::string colour, texture;
  if (!png.empty()) {
    colour = "\"baseColorTexture\":{\"index\":0},";
    texture = "\"images\":[{\"name\":\"photograph\",\"mimeType\":\"image/png\",\"bufferView\":" +
              number_text(to.add_view(png, kNoTarget)) +
              "}],\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":33071,\"wrapT\":33071}],"
              "\"textures\":[{\"sampler\":0,\"source\":0}],";
  }
  return "\"materials\":[{\"name\":\"face\",\"doubleSided\":true,\"pbrMetallicRoughness\":{" + colour +
         "\"metallicFactor\":0,\"roughnessFactor\":1}}]," + texture;
}

// What is known of the model, for programs that ask: numbers of the report, millimetres but where the name
// says otherwise.
std::string quality_text(const pipeline::ModelQuality& q) {
  std::string text;
  const auto add = [&text](const char* name, double value) {
    if (!std::isfinite(value) || std::abs(value) > 1e9) return;
    text += text.empty() ? "" : ",";
    text += std::string("\"") + name + "\":";
    append_rounded(text, value, 4);
  };
  for (const QualityFigure& figure : kQualityFigures) add(figure.name, q.*figure.of);
  add("off_sheet_mm", q.relief.off_sheet_mm);
  add("curvature_sr", q.relief.curvature_sr);
  return text;
}

// Places in the file's own frame and metres.
std::string landmark_text(const ExportMesh& mesh) {
  const double turn = mesh.frame == ExportFrame::Head ? 1 : -1;
  std::string text;
  for (const PlacedLandmark& l : placed_landmarks(mesh)) {
    text += text.empty() ? "\"" : ",\"";
    text += std::string(l.name) + "\":{\"at\":[";
    append_rounded(text, l.at_mm.x / 1000, 6);
    text += ",";
    append_rounded(text, turn * l.at_mm.y / 1000, 6);
    text += ",";
    append_rounded(text, turn * l.at_mm.z / 1000, 6);
    text += "],\"sigma_mm\":";
    append_rounded(text, l.sigma_mm, 2);
    text += "}";
  }
  return text;
}

std::string about(const ExportMesh& mesh) {
  return "\"asset\":{\"version\":\"2.0\",\"generator\":\"Relievo" +
         (mesh.version.empty() ? std::string() : " " + std::string(mesh.version)) +
         "\",\"extras\":{\"units\":\"metres\",\"quality\":{" + quality_text(mesh.model.quality) +
         "},\"landmarks\":{" + landmark_text(mesh) + "},\"frame\":\"" +
         (mesh.frame == ExportFrame::Head
              ? "head: origin at the tip of the nose, x to the person's left, y up, z out of the face"
              : "camera: origin at the left camera, x right, y up, z towards the camera") +
         "\"}},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":\"face\",\"mesh\":0}],";
}

// A chunk: its length, its kind, its bytes filled up to four.
void add_chunk(ByteWriter& to, std::string_view kind, std::span<const std::byte> bytes, char filler) {
  const std::size_t fill = (4 - bytes.size() % 4) % 4;
  to.put(std::uint32_t(bytes.size() + fill));
  to.put(bytes_of(kind));
  to.put(bytes);
  for (std::size_t i = 0; i < fill; ++i) to.put(filler);
}

}  // namespace

std::vector<std::byte> glb_bytes(const ExportMesh& mesh, std::span<const std::byte> png) {
  Buffer buffer;
  std::string json = "{" + about(mesh) + add_mesh(buffer, mesh);
  json += add_material(buffer, png);
  json += buffer.json() + "}";

  std::vector<std::byte> out;
  out.reserve(28 + json.size() + buffer.data().size() + 8);
  ByteWriter to(out);
  to.put(bytes_of("glTF"));
  to.put(std::uint32_t{2});
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  to.put(std::uint32_t(28 + padded(json.size()) + padded(buffer.data().size())));
  add_chunk(to, "JSON", bytes_of(json), ' ');
  add_chunk(to, std::string_view("BIN\0", 4), buffer.data(), '\0');
  return out;
}

}  // namespace relievo::storage
