#include "src/raster/surface/target_check.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <variant>

#include "ninebit/raster/fragment_probe.h"

namespace ninebit {
namespace {

Diagnostic fault(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

constexpr const char* kComponents[] = {"red", "green", "blue", "alpha"};

const char* name_of(OutputSource source) {
  switch (source) {
    case OutputSource::register_code:
      return "register codes";
    case OutputSource::output_code:
      return "output codes";
    case OutputSource::attribute:
      return "attributes";
    case OutputSource::primitive:
      return "primitive numbers";
    case OutputSource::depth:
      return "depth codes";
  }
  return "nothing that is known";
}

// In the order of OutputSamples.
constexpr const char* kSampleNames[] = {"s9", "8-bit", "16-bit", "32-bit", "half", "float"};
enum SampleBit : unsigned { kS9 = 1, kByte = 2, kWord = 4, kLong = 8, kHalf = 16, kFloat = 32 };

// The samples that can hold a source.
unsigned samples_of(OutputSource source, DepthStencilFormat format) {
  switch (source) {
    case OutputSource::register_code:
      return kS9;
    case OutputSource::output_code:
      return kS9 | kByte;
    case OutputSource::attribute:
      return kHalf | kFloat;
    case OutputSource::primitive:
      return kLong;
    case OutputSource::depth:
      return depth_bits(format) <= 16 ? kLong | kWord : kLong;
  }
  return 0;
}

std::string list_of(unsigned samples) {
  std::string list;
  for (unsigned i = 0; i < 6; ++i) {
    if (((samples >> i) & 1U) != 0) list += (list.empty() ? "" : " or ") + std::string(kSampleNames[i]);
  }
  return list;
}

bool is_fragment_register(Register reg) {
  return reg >= Register::fog && reg <= Register::texture3;
}

// The error in the step or stride of a plane, or empty.
template <class T>
std::string stride_complaint(const RenderTarget& target, const Plane<T>& plane) {
  if (!plane) return {};
  if (plane.step < 1 || plane.step > kMaxStep) {
    return "has a step of " + std::to_string(plane.step) + " samples between pixels; expected 1 to " +
           std::to_string(kMaxStep);
  }
  const std::ptrdiff_t row = (target.width - 1) * plane.step + 1;
  if (target.height == 1 || std::abs(plane.stride) >= row) return {};
  return "has overlapping rows: a stride of " + std::to_string(plane.stride) + " samples, rows of " +
         std::to_string(row);
}

// The error in an output plane, or empty.
std::string output_complaint(const RenderTarget& target, const OutputPlane& output) {
  const unsigned fitting = samples_of(output.source, target.format);
  if (fitting == 0) return "has an invalid source";
  if (((fitting >> output.plane.index()) & 1U) == 0) {
    return "stores " + std::string(name_of(output.source)) + " in " + kSampleNames[output.plane.index()] +
           " samples; expected " + list_of(fitting) + " samples";
  }
  const bool has_component = output.source != OutputSource::primitive && output.source != OutputSource::depth;
  if (has_component && (output.component < kRed || output.component > kAlpha)) {
    return "stores component " + std::to_string(output.component) + "; expected 0 to 3";
  }
  if (output.source == OutputSource::register_code && !is_fragment_register(output.reg)) {
    return "stores register " + std::string(ninebit::name_of(output.reg)) + ", which has no value per fragment";
  }
  if (output.source == OutputSource::attribute && (output.attribute < 0 || output.attribute >= kMaxAttributes)) {
    return "stores attribute " + std::to_string(output.attribute) + "; expected 0 to " +
           std::to_string(kMaxAttributes - 1);
  }
  return std::visit([&](const auto& plane) { return stride_complaint(target, plane); }, output.plane);
}

Status check_planes(const PipelineState& state, const RenderTarget& target) {
  const bool has_stencil_bits = stencil_bits(target.format) > 0;
  if (state.stencil_test.enabled && has_stencil_bits && !target.stencil) {
    return fault("the stencil test needs a stencil plane");
  }
  if (state.stencil_test.enabled && !has_stencil_bits && !layout_of(target.format).is_fixed_z()) {
    return fault("the stencil test is enabled, but the depth-stencil format " +
                 std::string(layout_of(target.format).name) + " has no stencil bits");
  }
  if (state.depth_test.enabled && !target.depth) return fault("the depth test needs a depth plane");
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::string complaint = stride_complaint(target, target.color[i]); !complaint.empty()) {
      return fault("the " + std::string(kComponents[i]) + " plane " + complaint);
    }
  }
  if (std::string complaint = stride_complaint(target, target.depth); !complaint.empty()) {
    return fault("the depth plane " + complaint);
  }
  if (std::string complaint = stride_complaint(target, target.stencil); !complaint.empty()) {
    return fault("the stencil plane " + complaint);
  }
  if (target.outputs.size() > kMaxOutputPlanes) {
    return fault("the target has " + std::to_string(target.outputs.size()) + " output planes; there are at most " +
                 std::to_string(kMaxOutputPlanes));
  }
  for (std::size_t i = 0; i < target.outputs.size(); ++i) {
    if (std::string complaint = output_complaint(target, target.outputs[i]); !complaint.empty()) {
      return fault("output plane " + std::to_string(i) + " " + complaint);
    }
  }
  return {};
}

}  // namespace

Status check_target(const PipelineState& state, const RenderTarget& target) {
  if (target.width < 1 || target.height < 1 || target.width > kMaxSurfaceSize || target.height > kMaxSurfaceSize) {
    return fault("the render target is " + std::to_string(target.width) + "x" + std::to_string(target.height) +
                 "; each side must be from 1 to " + std::to_string(kMaxSurfaceSize));
  }
  if (target.probes != nullptr) {
    for (const FragmentProbe& probe : *target.probes) {
      if (probe.x >= 0 && probe.y >= 0 && probe.x < target.width && probe.y < target.height) continue;
      return fault("the probe's pixel (" + std::to_string(probe.x) + ", " + std::to_string(probe.y) +
                   ") is outside of the render target");
    }
  }
  if (state.scissor && (state.scissor->width < 0 || state.scissor->height < 0)) {
    return fault("the scissor is " + std::to_string(state.scissor->width) + "x" +
                 std::to_string(state.scissor->height) + "; its sides must not be negative");
  }
  if (target.samples != SampleMode::center_1) {
    return fault("a prepared draw takes one sample for each pixel, not several; draw without preparation");
  }
  if (const ColorFormatFacts& facts = facts_of(target.color_format); state.blend.enabled && !facts.blends()) {
    return fault("the chip does not blend into surfaces of format " + std::string(facts.name) +
                 "; disable blending, or choose a format with red");
  }
  return check_planes(state, target);
}

Status check_samples(const PipelineState& state, const RenderTarget& target) {
  if (target.samples == SampleMode::center_1) return {};
  if (!state.profile.multisampling) {
    return fault("profile " + std::string(state.profile.name) +
                 " has no surfaces with several samples for each pixel; expected one sample");
  }
  if (target.probes != nullptr) return fault("a probe watches targets with one sample for each pixel, not several");
  return {};
}

Status check_output_attributes(const RenderTarget& target, const VertexArrays& arrays) {
  for (std::size_t i = 0; i < target.outputs.size(); ++i) {
    const OutputPlane& output = target.outputs[i];
    const bool holds = std::visit([](const auto& plane) { return static_cast<bool>(plane); }, output.plane);
    if (!holds || output.source != OutputSource::attribute) continue;
    if (!arrays.attributes[static_cast<std::size_t>(output.attribute)].empty() || arrays.vertex_count() == 0) continue;
    return fault("output plane " + std::to_string(i) + " stores attribute " + std::to_string(output.attribute) +
                 ", which the vertices do not have");
  }
  return {};
}

PixelRect scissored(const PipelineState& state, const RenderTarget& target) {
  const PixelRect whole{0, 0, target.width, target.height};
  if (!state.scissor) return whole;
  const PixelRect& s = *state.scissor;
  const auto overlap = [](int low, int size, int end, int& first, int& count) {
    const std::int64_t from = std::max<std::int64_t>(low, 0);
    const std::int64_t to = std::min<std::int64_t>(std::int64_t{low} + size, end);
    first = static_cast<int>(std::min<std::int64_t>(from, end));
    count = static_cast<int>(std::max<std::int64_t>(to - from, 0));
  };
  PixelRect rect;
  overlap(s.x, s.width, target.width, rect.x, rect.width);
  overlap(s.y, s.height, target.height, rect.y, rect.height);
  return rect;
}

}  // namespace ninebit
