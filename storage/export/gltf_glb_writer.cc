// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/glb_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <streambuf>

#include "storage/byte_order.h"
#include "storage/export/seam_split.h"

namespace relievo::storage {
namespace {

class VectorStream final : public std::streambuf {
 public:
  explicit VectorStream(std::vector<std::byte>& out) : out_(out) {}

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    const auto* bytes = reinterpret_cast<const std::byte*>(text);
    out_.insert(out_.end(), bytes, bytes + size);
    return size;
  }
  int overflow(int c) override {
    if (c != EOF) out_.push_back(static_cast<std::byte>(c));
    return 0;
  }
  std::vector<std::byte>& out_;
};

// Puts together the one buffer of a GLB file: a view and an accessor for each array.
class Builder {
 public:
  explicit Builder(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

  int add_view(std::span<const std::byte> bytes, int target) {
    auto& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = bytes.size();
    view.target = target;
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    data.insert(data.end(), first, first + bytes.size());
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  // `components` numbers each; a bound for each component where asked for.
  template <typename T>
  int add_array(const std::vector<T>& values, int components, int component_type, int target, bool bounds) {
    std::vector<std::byte> bytes;
    bytes.reserve(values.size() * sizeof(T));
    ByteWriter(bytes).put_run<T, T>(std::span<const T>(values));
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(bytes, target);
    accessor.componentType = component_type;
    accessor.count = values.size() / static_cast<std::size_t>(components);
    accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components == 2 ? TINYGLTF_TYPE_VEC2 : TINYGLTF_TYPE_VEC3;
    for (int c = 0; bounds && c < components; ++c) {
      T low = values[static_cast<std::size_t>(c)], high = low;
      for (std::size_t i = static_cast<std::size_t>(c); i < values.size(); i += static_cast<std::size_t>(components)) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      accessor.minValues.push_back(static_cast<double>(low));
      accessor.maxValues.push_back(static_cast<double>(high));
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_floats(const std::vector<float>& values, int components, bool bounds = false) {
    return add_array(values, components, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, bounds);
  }

 private:
  tinygltf::Model& model_;
};

// glTF's colours of vertices are linear light, ours are coded as sRGB (IEC 61966-2-1).
float linear(std::uint8_t coded) {
  const float value = static_cast<float>(coded) / 255.0f;
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

tinygltf::Primitive add_vertices(Builder& to, const ExportMesh& mesh, const SeamSplit& split) {
  const auto& source = mesh.model.mesh;
  const float turn = mesh.frame == ExportFrame::Head ? 1.0f : -1.0f;
  std::vector<float> positions, normals, uvs, colours, sigmas, measured;
  positions.reserve(split.entries.size() * 3);
  normals.reserve(split.entries.size() * 3);
  for (const auto& [vertex, uv] : split.entries) {
    const auto& at = mesh.vertices_mm[vertex];
    const auto& normal = mesh.normals[vertex];
    positions.insert(positions.end(), {at.x / 1000.0f, turn * at.y / 1000.0f, turn * at.z / 1000.0f});
    normals.insert(normals.end(), {normal.x, turn * normal.y, turn * normal.z});
    if (mesh.textured()) uvs.insert(uvs.end(), {uv.x, uv.y});
    else for (const std::uint8_t c : mesh.colours[vertex]) colours.push_back(linear(c));
    if (!source.sigma_mm.empty()) sigmas.push_back(std::isfinite(source.sigma_mm[vertex]) ? source.sigma_mm[vertex] : 0.0f);
    if (!source.measured.empty()) measured.push_back(source.measured[vertex] != 0 ? 1.0f : 0.0f);
  }
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = to.add_floats(positions, 3, true);
  primitive.attributes["NORMAL"] = to.add_floats(normals, 3);
  if (!uvs.empty()) primitive.attributes["TEXCOORD_0"] = to.add_floats(uvs, 2);
  if (!colours.empty()) primitive.attributes["COLOR_0"] = to.add_floats(colours, 3);
  if (!sigmas.empty()) primitive.attributes["_SIGMA_MM"] = to.add_floats(sigmas, 1);
  if (!measured.empty()) primitive.attributes["_MEASURED"] = to.add_floats(measured, 1);

  std::vector<std::uint32_t> indices;
  indices.reserve(split.triangles.size() * 3);
  for (const auto& triangle : split.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  primitive.indices = to.add_array(indices, 1, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, false);
  primitive.material = 0;
  return primitive;
}

void add_material(tinygltf::Model& model, Builder& to, std::span<const std::byte> png) {
  tinygltf::Material material;
  material.name = "face";
  material.doubleSided = true;  // a surface of a face is open at its edge
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 1.0;
  if (!png.empty()) {
    tinygltf::Image image;
    image.name = "photograph";
    image.mimeType = "image/png";
    image.bufferView = to.add_view(png, 0);
    model.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);
    tinygltf::Texture texture;
    texture.source = texture.sampler = 0;
    model.textures.push_back(texture);
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
  }
  model.materials.push_back(material);
}

void describe(tinygltf::Model& model, const ExportMesh& mesh) {
  model.asset.version = "2.0";
  model.asset.generator = "Relievo";
  const bool head = mesh.frame == ExportFrame::Head;
  tinygltf::Value::Object extras;
  extras["units"] = tinygltf::Value(std::string("metres"));
  extras["frame"] = tinygltf::Value(std::string(head ? "head: origin at the tip of the nose, x to the person's left, y up, z out of the face"
                                                     : "camera: origin at the left camera, x right, y up, z towards the camera"));
  model.asset.extras = tinygltf::Value(extras);
}

}  // namespace

Result<std::vector<std::byte>> glb_bytes(const ExportMesh& mesh, std::span<const std::byte> png) {
  tinygltf::Model model;
  describe(model, mesh);
  Builder builder(model);
  tinygltf::Mesh face;
  face.name = "face";
  face.primitives.push_back(add_vertices(builder, mesh, split_at_seams(mesh)));
  model.meshes.push_back(face);
  add_material(model, builder, png);
  tinygltf::Node node;
  node.name = "face";
  node.mesh = 0;
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;

  std::vector<std::byte> out;
  out.reserve(model.buffers[0].data.size() + 8192);
  VectorStream buffer(out);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit);  // else a lack of memory would end in silence
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true) || !stream) {
    return Error{Errc::LibraryFailed, "the GLB file could not be put together; please report this"};
  }
  return out;
}

}  // namespace relievo::storage
