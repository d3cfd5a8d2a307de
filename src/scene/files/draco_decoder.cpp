#include "src/scene/files/draco_decoder.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "src/scene/fault_of.h"

namespace ninebit {
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
