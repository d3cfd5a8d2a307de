#include "combiner_tests/raster/support.h"

#include <gtest/gtest.h>

namespace ninebit::test {
namespace {

constexpr int kPadding = 3;
constexpr std::uint8_t kUntouched = 0xA5;

template <class T>
bool is_padding_whole(const std::vector<T>& plane, int width, int stride) {
  for (std::size_t i = 0; i < plane.size(); ++i) {
    if (static_cast<int>(i % static_cast<std::size_t>(stride)) >= width && plane[i] != T{kUntouched}) return false;
  }
  return true;
}

}  // namespace

glm::vec3 clip_position(const oracle::WindowVertex& v, const PixelRect& viewport, int subpixel_bits,
                        DepthStencilFormat format) {
  const int cell = 1 << (4 - subpixel_bits);
  const auto clip = [&](std::int64_t q4, int start, int size) {
    // Truncation toward zero: the cell of a position reaches away from zero.
    const double middle = static_cast<double>(q4) + (q4 > 0 ? 0.5 : q4 < 0 ? -0.5 : 0.0) * cell;
    return static_cast<float>((middle / 16.0 - start) / (size * 0.5) - 1.0);
  };
  const auto deepest = static_cast<double>(std::int64_t{max_depth(format)} << (24 - depth_bits(format)));
  return {clip(v.x_q4, viewport.x, viewport.width), clip(v.y_q4, viewport.y, viewport.height),
          static_cast<float>(static_cast<double>(v.z24) * 2 / deepest - 1)};
}

glm::vec3 clip_position(const oracle::WindowVertex& v, int width, int height, int subpixel_bits) {
  return clip_position(v, {0, 0, width, height}, subpixel_bits);
}

Canvas::Canvas(int width, int height, bool with_capture) : stride_(width + kPadding) {
  const auto count = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height);
  target.width = width;
  target.height = height;
  for (std::size_t i = 0; i < 4; ++i) {
    color_[i].assign(count, kUntouched);
    target.color[i] = {color_[i].data(), stride_};
  }
  depth_.assign(count, kUntouched);
  primitive_.assign(count, kUntouched);
  stencil_.assign(count, kUntouched);
  captured_.assign(count, kUntouched);
  target.depth = {depth_.data(), stride_};
  target.stencil = {stencil_.data(), stride_};
  target.outputs.push_back(
      {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{primitive_.data(), stride_}});
  if (with_capture) {
    target.outputs.push_back({.source = OutputSource::output_code,
                              .component = kRed,
                              .time = OutputTime::at_depth_pass,
                              .plane = Plane<s9>{captured_.data(), stride_}});
  }
}

oracle::Picture Canvas::picture() const {
  oracle::Picture p;
  p.width = target.width;
  p.height = target.height;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const auto at = static_cast<std::size_t>(y * stride_ + x);
      p.color.push_back({color_[0][at], color_[1][at], color_[2][at], color_[3][at]});
      p.depth.push_back(depth_[at]);
      p.stencil.push_back(stencil_[at]);
      p.primitive.push_back(primitive_[at]);
      p.captured.push_back(captured_[at]);
    }
  }
  return p;
}

void Canvas::load(const oracle::Picture& p) {
  std::size_t from = 0;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x, ++from) {
      const auto at = static_cast<std::size_t>(y * stride_ + x);
      for (std::size_t i = 0; i < 4; ++i) color_[i][at] = p.color[from][i];
      depth_[at] = p.depth[from];
      stencil_[at] = p.stencil[from];
      primitive_[at] = p.primitive[from];
      captured_[at] = static_cast<s9>(p.captured[from]);
    }
  }
}

bool Canvas::padding_is_whole() const {
  bool whole = is_padding_whole(depth_, target.width, stride_) && is_padding_whole(stencil_, target.width, stride_) &&
               is_padding_whole(primitive_, target.width, stride_) &&
               is_padding_whole(captured_, target.width, stride_);
  for (const auto& plane : color_) whole = whole && is_padding_whole(plane, target.width, stride_);
  return whole;
}

std::uint32_t Mesh::add(const glm::vec3& position) {
  positions.push_back(position);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

VertexArrays Mesh::arrays() const {
  VertexArrays arrays;
  arrays.positions = positions;
  arrays.indices = index_list(triangles);
  arrays.vertex_colors = vertex_colors;
  arrays.primitive_colors = triangle_colors;
  arrays.texture_coordinates[0] = texture_coordinates;
  return arrays;
}

PipelineState counting_state() {
  PipelineState state;
  state.color_mask = {false, false, false, false};
  state.stencil_test.enabled = true;
  state.stencil_test.front.depth_pass = StencilOperation::incr;
  return state;
}

PlaneSamples<std::uint8_t> coverage(const Mesh& mesh, const glm::mat4& matrix, int width, int height, CullFace cull) {
  Surface surface = Surface::make(width, height).value();
  RenderTarget target = surface.target();
  PipelineState state = counting_state();
  state.cull_face = cull;
  const Status status = rasterize(state, matrix, mesh.arrays(), {}, target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return surface.stencil();
}

Program pass_through(Register rgb, Register alpha, const HardwareProfile& profile) {
  CombinerState state;
  state.general[0].rgb.out.sum = Register::discard;
  state.general[0].alpha.out.sum = Register::discard;
  state.final_combiner = {};
  state.final_combiner.a = {};
  state.final_combiner.b = {};
  state.final_combiner.c = {};
  state.final_combiner.d = {rgb, InputMapping::unsigned_identity, ComponentUsage::rgb};
  state.final_combiner.g = {alpha, InputMapping::unsigned_identity, ComponentUsage::alpha};
  const Result<Program> program = compile(state, profile);
  EXPECT_TRUE(program.ok()) << program.error().message;
  return *program;
}

glm::mat4 perspective(double half_angle_tangent, double aspect, double near_plane, double far_plane) {
  glm::mat4 m(0.0F);
  m[0][0] = static_cast<float>(1.0 / (half_angle_tangent * aspect));
  m[1][1] = static_cast<float>(1.0 / half_angle_tangent);
  m[2][2] = static_cast<float>((far_plane + near_plane) / (near_plane - far_plane));
  m[3][2] = static_cast<float>(2.0 * far_plane * near_plane / (near_plane - far_plane));
  m[2][3] = -1.0F;
  return m;
}

}  // namespace ninebit::test
