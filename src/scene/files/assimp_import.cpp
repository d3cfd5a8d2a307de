#include "src/scene/files/assimp_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <initializer_list>
#include <new>
#include <string>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "src/scene/files/mesh_builder.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
  // aiMatrix4x4 is row-major, glm column-major.
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

Wrap wrap_of(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
      return Wrap::clamp_to_edge;
    case aiTextureMapMode_Mirror:
      return Wrap::mirrored_repeat;
    default:
      return Wrap::repeat;
  }
}

// Contents that Assimp read and that a scene cannot hold.
std::vector<std::string> notes_of(const aiScene& from) {
  const auto any_material = [&](const auto& test) {
    return std::any_of(from.mMaterials, from.mMaterials + from.mNumMaterials,
                       [&](const aiMaterial* material) { return test(*material); });
  };
  const auto any_mesh = [&](const auto& test) {
    return std::any_of(from.mMeshes, from.mMeshes + from.mNumMeshes, [&](const aiMesh* mesh) { return test(*mesh); });
  };
  const auto has_texture = [&](std::initializer_list<aiTextureType> types) {
    return any_material([&](const aiMaterial& m) {
      return std::any_of(types.begin(), types.end(), [&](aiTextureType type) { return m.GetTextureCount(type) > 0; });
    });
  };
  std::vector<std::string> notes;
  const auto note = [&](bool there, const char* text) {
    if (there) notes.emplace_back(text);
  };
  note(has_texture({aiTextureType_NORMALS, aiTextureType_HEIGHT, aiTextureType_NORMAL_CAMERA}), "normal maps");
  note(has_texture({aiTextureType_SPECULAR, aiTextureType_SHININESS, aiTextureType_METALNESS,
                    aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_AMBIENT, aiTextureType_AMBIENT_OCCLUSION,
                    aiTextureType_EMISSIVE, aiTextureType_REFLECTION, aiTextureType_LIGHTMAP, aiTextureType_OPACITY}),
       "textures other than the base colour's");
  note(any_material([](const aiMaterial& m) {
         ai_real opacity = 1.0F;
         return m.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity < 1.0F;
       }),
       "alpha blending");
  note(any_mesh([](const aiMesh& mesh) { return mesh.mNumBones > 0; }), "skins");
  note(any_mesh([](const aiMesh& mesh) { return mesh.mNumAnimMeshes > 0; }), "morph targets");
  note(from.mNumAnimations > 0, "animations");
  return notes;
}

class SceneFlattener {
 public:
  explicit SceneFlattener(const aiScene& from) : from_(from), builder_(out_) {}

  Result<Scene> flatten() {
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) out_.materials.push_back(material_of(*from_.mMaterials[i]));
    if (from_.mRootNode != nullptr) {
      if (auto fault = add_node(*from_.mRootNode, glm::dmat4(1.0))) return *fault;
    }
    out_.notes = notes_of(from_);
    return std::move(out_);
  }

 private:
  Material material_of(const aiMaterial& from) {
    Material out;
    out.name = from.GetName().C_Str();
    aiColor4D color;
    if (from.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS ||
        from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
      const glm::vec3 rgb(color.r, color.g, color.b);
      if (is_finite(rgb)) out.base_color = glm::clamp(rgb, 0.0F, 1.0F);
    }
    add_texture(from, aiTextureType_DIFFUSE, out);
    add_texture(from, aiTextureType_BASE_COLOR, out);
    return out;
  }

  // In these formats a texture replaces the colour. The file of a picture is found by the caller.
  void add_texture(const aiMaterial& from, aiTextureType type, Material& out) {
    aiString path;
    unsigned coordinates = 0;
    std::array<aiTextureMapMode, 2> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (out.base_texture ||
        from.GetTexture(type, 0, &path, nullptr, &coordinates, nullptr, nullptr, modes.data()) != aiReturn_SUCCESS) {
      return;
    }
    if (coordinates != 0 || path.length == 0) return;
    out.base_texture = texture_of(path.C_Str());
    out.base_color = glm::vec3(1.0F);
    out.sampler = {
        .min_filter = MinFilter::linear_mipmap_linear, .wrap_s = wrap_of(modes[0]), .wrap_t = wrap_of(modes[1])};
  }

  std::uint32_t texture_of(const std::string& name) {
    const auto [place, added] = textures_.try_emplace(name, static_cast<std::uint32_t>(out_.textures.size()));
    if (!added) return place->second;
    SceneTexture texture{.name = name};
    // A height of 0: the texture is a picture file of mWidth bytes.
    const aiTexture* const embedded = from_.GetEmbeddedTexture(name.c_str());
    if (embedded != nullptr && embedded->mHeight == 0) {
      texture.bytes.assign(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth);
      if (texture.bytes.empty()) texture.fault = "is empty";
    } else if (embedded != nullptr) {
      texture.fault = "is embedded as texels; expected a picture file";
    }
    out_.textures.push_back(std::move(texture));
    return place->second;
  }

  std::optional<Diagnostic> add_node(const aiNode& node, const glm::dmat4& parent) {
    const glm::dmat4 world = parent * matrix_of(node.mTransformation);
    if (node.mNumMeshes > 0) {
      builder_.begin_object(node.mName.C_Str());
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= from_.mNumMeshes) return fault_of("a node names a mesh that does not exist");
        if (auto fault = add_mesh(*from_.mMeshes[node.mMeshes[i]], MeshPlace::of(world))) return fault;
      }
      builder_.end_object();
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (auto fault = add_node(*node.mChildren[i], world)) return fault;
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> add_mesh(const aiMesh& mesh, const MeshPlace& place) {
    const std::uint32_t material = material_index(mesh.mMaterialIndex);
    std::vector<std::uint32_t> placed(mesh.mNumVertices, VertexTable::kFree);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines have no surface
      corners_.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned index = face.mIndices[k];
        if (index >= mesh.mNumVertices)
          return fault_of(fmt::format("vertex index {} is out of range: the mesh has {}, counted from 0", index,
                                      mesh.mNumVertices));
        if (placed[index] == VertexTable::kFree) {
          if (auto fault = builder_.vertex_at(place, vertex_of(mesh, index), placed[index])) return fault_of(*fault);
        }
        corners_.push_back(placed[index]);
      }
      if (auto fault = builder_.polygon(corners_, material, place.mirrored)) return fault_of(*fault);
    }
    return std::nullopt;
  }

  static MeshVertex vertex_of(const aiMesh& mesh, unsigned index) {
    const auto vector = [](const aiVector3D& v) { return glm::vec3(v.x, v.y, v.z); };
    MeshVertex out{.position = vector(mesh.mVertices[index])};
    if (mesh.mNormals != nullptr) out.normal = vector(mesh.mNormals[index]);
    if (const aiVector3D* const uv = mesh.mTextureCoords[0]; uv != nullptr) {
      // Assimp's origin is the lower left corner of a picture.
      const glm::vec2 st(uv[index].x, 1.0F - uv[index].y);
      if (std::isfinite(st.x) && std::isfinite(st.y)) out.texture_coordinate = st;
    }
    if (const aiColor4D* const colors = mesh.mColors[0]; colors != nullptr) {
      const aiColor4D& c = colors[index];
      const glm::vec4 rgba(c.r, c.g, c.b, c.a);
      if (is_finite(glm::vec3(rgba)) && std::isfinite(rgba.a)) out.color = glm::clamp(rgba, 0.0F, 1.0F);
    }
    return out;
  }

  std::uint32_t material_index(unsigned index) {
    if (index < out_.materials.size()) return index;
    out_.materials.emplace_back();
    return static_cast<std::uint32_t>(out_.materials.size() - 1);
  }

  const aiScene& from_;
  Scene out_;
  MeshBuilder builder_;
  std::unordered_map<std::string, std::uint32_t> textures_;  // by name
  std::vector<std::uint32_t> corners_;                       // of the current polygon, as vertices of the scene
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
  out.has_viewpoints = from->mNumCameras > 0 || from->mNumLights > 0;
  int up = -1;
  if (from->mMetaData != nullptr && from->mMetaData->Get("UpAxis", up) && up == 2) out.z_up = true;
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

namespace {

bool is_there(const NamedFiles& beside, const std::string& name) {
  std::error_code error;
  return beside.check(name).ok() && std::filesystem::exists(beside.path_of(name), error);
}

// Whether a file was found; then the texture has its name.
bool find_picture(const NamedFiles& beside, SceneTexture& texture) {
  std::string name = texture.name;
  std::replace(name.begin(), name.end(), '\\', '/');
  for (const std::string& one : {name, name.substr(name.rfind('/') + 1)}) {
    if (one.empty() || !is_there(beside, one)) continue;
    name_picture(beside, one, texture);
    return true;
  }
  return false;
}

}  // namespace

void find_pictures(const NamedFiles& beside, Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    SceneTexture& texture = scene.textures[i];
    if (!texture.bytes.empty() || !texture.fault.empty() || find_picture(beside, texture)) continue;
    scene.notes.push_back(fmt::format("the texture '{}', which was not found", texture.name));
    for (Material& material : scene.materials) {
      if (material.base_texture != static_cast<std::uint32_t>(i)) continue;
      material.base_texture.reset();
      material.base_color = Material{}.base_color;
    }
  }
}

}  // namespace ninebit
