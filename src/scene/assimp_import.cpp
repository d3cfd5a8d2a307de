#include "src/scene/assimp_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <limits>
#include <new>

#include "src/scene/fault_of.h"
#include "src/scene/mesh_builder.h"
#include "src/scene/polygon.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
  // aiMatrix4x4 is row-major, glm column-major.
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

// The inverse transpose of a transform's linear part, up to a positive factor; also defined for singular transforms.
glm::dmat3 normal_transform(const glm::dmat4& world, double determinant) {
  const glm::dvec3 x(world[0]);
  const glm::dvec3 y(world[1]);
  const glm::dvec3 z(world[2]);
  const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  return determinant < 0.0 ? -cofactors : cofactors;
}

Material material_of(const aiMaterial& from) {
  Material out;
  out.name = from.GetName().C_Str();
  aiColor4D color;
  if (from.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
      from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
    const glm::vec3 rgb(color.r, color.g, color.b);
    if (is_finite(rgb)) out.base_color = glm::clamp(rgb, 0.0F, 1.0F);
  }
  return out;
}

class SceneFlattener {
 public:
  explicit SceneFlattener(const aiScene& from) : from_(from), builder_(out_) {}

  Result<Scene> flatten() {
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) out_.materials.push_back(material_of(*from_.mMaterials[i]));
    if (from_.mRootNode != nullptr) {
      if (auto fault = add_node(*from_.mRootNode, glm::dmat4(1.0))) return *fault;
    }
    return std::move(out_);
  }

 private:
  std::optional<Diagnostic> add_node(const aiNode& node, const glm::dmat4& parent) {
    const glm::dmat4 world = parent * matrix_of(node.mTransformation);
    if (node.mNumMeshes > 0) {
      builder_.begin_object(node.mName.C_Str());
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= from_.mNumMeshes) return fault_of("a node names a mesh that does not exist");
        if (auto fault = add_mesh(*from_.mMeshes[node.mMeshes[i]], world)) return fault;
      }
      builder_.end_object();
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (auto fault = add_node(*node.mChildren[i], world)) return fault;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> add_mesh(const aiMesh& mesh, const glm::dmat4& world) {
    const double determinant = glm::determinant(glm::dmat3(world));
    const bool mirrored = determinant < 0.0;
    const glm::dmat3 normals = normal_transform(world, determinant);
    const std::uint32_t material = material_index(mesh.mMaterialIndex);
    std::vector<std::uint32_t> placed(mesh.mNumVertices, kNotPlaced);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines have no surface
      corners_.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned index = face.mIndices[k];
        if (index >= mesh.mNumVertices)
          return fault_of(fmt::format("vertex index {} is out of range: the mesh has {}, counted from 0", index,
                                      mesh.mNumVertices));
        if (placed[index] == kNotPlaced) {
          if (auto fault = place_vertex(mesh, index, world, normals, placed[index])) return fault;
        }
        corners_.push_back(placed[index]);
      }
      if (auto fault = add_polygon(material, mirrored)) return fault;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> place_vertex(const aiMesh& mesh, unsigned index, const glm::dmat4& world,
                                         const glm::dmat3& normals, std::uint32_t& placed) {
    const aiVector3D& at = mesh.mVertices[index];
    const glm::vec3 position(glm::dvec3(world * glm::dvec4(at.x, at.y, at.z, 1.0)));
    if (!is_finite(position)) return fault_of("the position of a vertex is not finite");
    glm::vec3 normal(0.0F);
    if (mesh.mNormals != nullptr) {
      const aiVector3D& n = mesh.mNormals[index];
      const glm::dvec3 turned = normals * glm::dvec3(n.x, n.y, n.z);
      const double length = glm::length(turned);
      if (length > 0.0 && std::isfinite(length)) normal = glm::vec3(turned / length);
    }
    if (out_.positions.size() >= kNotPlaced) return fault_of("has more than 2^32 - 1 vertices");
    placed = builder_.vertex({.position = position, .normal = normal});
    return std::nullopt;
  }

  std::optional<Diagnostic> add_polygon(std::uint32_t material, bool mirrored) {
    if (out_.triangles.size() + corners_.size() >= kNotPlaced) return fault_of("has more than 2^32 - 1 triangles");
    outline_.clear();
    for (const std::uint32_t corner : corners_) outline_.push_back(out_.positions[corner]);
    pieces_.clear();
    if (!triangulate(outline_, pieces_))
      return fault_of(fmt::format("has a concave polygon with more than {} corners", kMostConcaveCorners));
    for (const auto& [a, b, c] : pieces_) {
      const std::uint32_t second = mirrored ? c : b;
      const std::uint32_t third = mirrored ? b : c;
      builder_.triangle({corners_[a], corners_[second], corners_[third]}, material);
    }
    return std::nullopt;
  }

  std::uint32_t material_index(unsigned index) {
    if (index < out_.materials.size()) return index;
    out_.materials.emplace_back();
    return static_cast<std::uint32_t>(out_.materials.size() - 1);
  }

  static constexpr std::uint32_t kNotPlaced = std::numeric_limits<std::uint32_t>::max();

  const aiScene& from_;
  Scene out_;
  MeshBuilder builder_;
  std::vector<std::uint32_t> corners_;  // of the current polygon, as vertices of the scene
  std::vector<glm::vec3> outline_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

// A file system with a single file, whose content is in memory.
class OneFileInMemory : public Assimp::IOSystem {
 public:
  OneFileInMemory(std::string name, std::string_view content) : name_(std::move(name)), content_(content) {}

  [[nodiscard]] bool Exists(const char* file) const override { return name_ == file; }
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    if (name_ != file) return nullptr;
    // Assimp deletes the stream through Close(); it does not own the bytes.
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(content_.data()), content_.size(), false);
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::string_view content_;
};

Result<Imported> import_or_throw(const std::filesystem::path& file, std::string_view content) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFileInMemory(file.string(), content));  // the importer owns it
  // No post-processing: Assimp's joins vertices within a tolerance, drops faces, and adds normals that split vertices
  // which the file shares.
  const aiScene* from = importer.ReadFile(file.string(), 0);
  if (importer.GetException() != nullptr) std::rethrow_exception(importer.GetException());
  if (from == nullptr) return fault_of(std::string("cannot be read: ") + importer.GetErrorString());
  Result<Scene> scene = SceneFlattener(*from).flatten();
  if (!scene) return scene.error();
  Imported out{std::move(scene).value(), glm::dmat4(1.0)};
  if (from->mRootNode != nullptr) out.root_transform = matrix_of(from->mRootNode->mTransformation);
  return out;
}

}  // namespace

Result<Imported> import_geometry(const std::filesystem::path& file, std::string_view content) {
  try {
    return import_or_throw(file, content);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return fault_of(std::string("cannot be read: ") + error.what());
  } catch (...) {
    return fault_of("cannot be read: its importer failed");
  }
}

}  // namespace ninebit
