#include "src/scene/files/draco_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "src/scene/fault_of.h"
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

}  // namespace ninebit
