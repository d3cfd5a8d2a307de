#include "src/scene/files/draco_meshes.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "src/scene/scene_check.h"
#include "src/system/isolated_call.h"

namespace ninebit {
namespace {

constexpr const char* kDracoReader = "Draco's reader";

// The number of bytes that belong to at least one stream.
std::uint64_t distinct_bytes(std::span<const DracoRequest> requests) {
  std::vector<std::pair<std::uintptr_t, std::uintptr_t>> ranges;
  for (const DracoRequest& request : requests) {
    const auto start = reinterpret_cast<std::uintptr_t>(request.stream.data());
    ranges.emplace_back(start, start + request.stream.size());
  }
  std::sort(ranges.begin(), ranges.end());
  std::uint64_t bytes = 0;
  std::uintptr_t counted = 0;  // bytes below this address are counted
  for (const auto& [start, end] : ranges) {
    bytes += std::max(end, counted) - std::max(start, counted);
    counted = std::max(end, counted);
  }
  return bytes;
}

posix::CallLimits draco_limits(std::span<const DracoRequest> requests) {
  const std::uint64_t bytes = distinct_bytes(requests);
  std::uint64_t triangles = 0;
  for (const DracoRequest& request : requests) triangles += request.most_triangles;
  return {.memory_bytes = (std::uint64_t{1} << 30U) + 64 * bytes + 256 * triangles,
          .seconds = 8 + static_cast<int>(bytes / 1'000'000) + static_cast<int>(triangles >> 20U)};
}

Diagnostic fault_in(const DracoRequest& request, const std::string& message) {
  return fault_of(fmt::format("{} {}", request.name, message));
}

// The answer is 1 and the mesh, or 0 and the fault's message.
void write_mesh(posix::AnswerWriter& to, const Result<DracoMesh>& mesh) {
  to.value(std::uint8_t{mesh.ok()});
  if (!mesh) return to.text(mesh.error().message);
  to.text(mesh->indices);
  to.text(mesh->positions);
  to.text(mesh->normals);
}

// Reads one request's answer without trusting it; nothing if it is not valid.
std::optional<Result<DracoMesh>> read_mesh(posix::AnswerReader& from, const DracoRequest& request) {
  std::uint8_t good = 0;
  if (!from.value(good)) return std::nullopt;
  if (good == 0) {
    std::string message;
    if (!from.text(message)) return std::nullopt;
    return fault_in(request, message);
  }
  DracoMesh mesh;
  if (!from.text(mesh.indices) || !from.text(mesh.positions) || !from.text(mesh.normals)) return std::nullopt;
  if (!fits(mesh, request)) return std::nullopt;
  return mesh;
}

Result<std::vector<DracoMesh>> decode_isolated(DracoDecode decode, std::span<const DracoRequest> requests,
                                               const std::function<bool()>& go_on) {
  const posix::CallLimits limits = draco_limits(requests);
  const auto work = [&](posix::AnswerWriter& answer) {
    for (const DracoRequest& request : requests) {
      const Result<DracoMesh> mesh = decode(request);
      write_mesh(answer, mesh);
      if (!mesh) return;
    }
  };
  posix::CallResult call = posix::call_isolated(limits, {}, work, go_on);
  if (call.end == posix::CallEnd::stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (call.end != posix::CallEnd::answered) return fault_of(posix::describe(call.end, limits, kDracoReader));
  std::vector<DracoMesh> meshes;
  for (const DracoRequest& request : requests) {
    std::optional<Result<DracoMesh>> mesh = read_mesh(call.answer, request);
    if (!mesh) return fault_of(std::string(kDracoReader) + " gave no mesh");
    if (!*mesh) return mesh->error();
    meshes.push_back(std::move(*mesh).value());
  }
  if (call.answer.bytes_left() != 0) return fault_of(std::string(kDracoReader) + " gave no mesh");
  return meshes;
}

}  // namespace

Result<std::vector<DracoMesh>> decode_all(DracoDecode decode, std::span<const DracoRequest> requests,
                                          const SceneReadOptions& options) {
  for (const DracoRequest& request : requests) {
    if (auto fault = check_draco(request.stream, request.most_triangles)) return fault_in(request, *fault);
  }
  if (options.isolated) return decode_isolated(decode, requests, options.go_on);
  std::vector<DracoMesh> meshes;
  for (const DracoRequest& request : requests) {
    Result<DracoMesh> mesh = decode(request);
    if (!mesh) return fault_in(request, mesh.error().message);
    if (!fits(*mesh, request)) return fault_of(std::string(kDracoReader) + " gave no mesh");
    meshes.push_back(std::move(mesh).value());
  }
  return meshes;
}

namespace {

static_assert(std::endian::native == std::endian::little, "Draco and DracoMesh store numbers as this machine does");

draco::DataType draco_type(std::uint64_t component) {
  if (component == 5126) return draco::DT_FLOAT32;
  return component == 5122 ? draco::DT_INT16 : draco::DT_INT8;
}

// Copies the values of one attribute, vertex by vertex. Returns a fault if the attribute differs from its accessor.
std::optional<std::string> copy_values(const draco::Mesh& mesh, const char* name, const DracoAttribute& wanted,
                                       std::string& out) {
  const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(wanted.id);
  if (from == nullptr)
    return fmt::format("has no compressed attribute with the id {}, which {} names", wanted.id, name);
  if (from->num_components() != 3 || from->data_type() != draco_type(wanted.component))
    return fmt::format("has compressed data whose type differs from the accessor of its {}", name);
  const auto size = static_cast<std::size_t>(draco::DataTypeLength(from->data_type())) * 3;
  const bool packed = from->byte_stride() == static_cast<std::int64_t>(size) && from->byte_offset() == 0;
  if (!packed || (!from->is_mapping_identity() && from->indices_map_size() < mesh.num_points()))
    return fmt::format("has compressed data with an incomplete {}", name);
  const std::size_t values = from->buffer()->data_size() / size;
  out.resize(mesh.num_points() * size);
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    const std::size_t value = from->mapped_index(draco::PointIndex(i)).value();
    if (value >= values) return fmt::format("has compressed data with an incomplete {}", name);
    std::memcpy(out.data() + i * size, from->buffer()->data() + value * size, size);
  }
  return std::nullopt;
}

Result<DracoMesh> decode_or_throw(const DracoRequest& request) {
  draco::DecoderBuffer buffer;
  buffer.Init(request.stream.data(), request.stream.size());
  draco::Decoder decoder;
  draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    const std::string& reason = decoded.status().error_msg_string();
    return fault_of(fmt::format("cannot be decompressed: {}", reason.empty() ? "Draco gives no reason" : reason));
  }
  const draco::Mesh& mesh = *decoded.value();
  // check_draco() and Draco may read a stream differently.
  if (mesh.num_faces() > request.most_triangles || mesh.num_points() > 3 * std::uint64_t{mesh.num_faces()})
    return fault_of("has compressed data whose size differs from its header's");
  DracoMesh out;
  out.indices.resize(std::size_t{mesh.num_faces()} * 12);
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = face[k].value();
      if (index >= mesh.num_points()) return fault_of("has compressed data with a vertex index out of range");
      std::memcpy(out.indices.data() + 12 * std::size_t{i} + 4 * k, &index, 4);
    }
  }
  if (request.positions) {
    if (auto fault = copy_values(mesh, "POSITION", *request.positions, out.positions)) return fault_of(*fault);
  }
  if (request.normals) {
    if (auto fault = copy_values(mesh, "NORMAL", *request.normals, out.normals)) return fault_of(*fault);
  }
  return out;
}

}  // namespace

Result<DracoMesh> decode_draco(const DracoRequest& request) {
  try {
    return decode_or_throw(request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return fault_of(fmt::format("cannot be decompressed: {}", error.what()));
  }
}

}  // namespace ninebit
