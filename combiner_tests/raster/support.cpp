#include "combiner_tests/raster/support.h"

#include <gtest/gtest.h>

namespace ninebit::test {
namespace {

constexpr int kPadding = 3;
constexpr std::uint8_t kUntouched = 0xA5;

// Samples of which a group of `group` side by side belongs to each pixel.
template <class T>
bool is_padding_whole(const std::vector<T>& samples, const Plane<T>& plane, int width, std::size_t group = 1) {
  const auto stride = static_cast<std::size_t>(plane.stride), step = static_cast<std::size_t>(plane.step);
  for (std::size_t row = 0; row < samples.size(); row += stride) {
    std::size_t pixel = 0, within = 0;
    for (std::size_t i = row; i < row + stride; ++i) {
      const bool is_sample = pixel < static_cast<std::size_t>(width) && within < group;
      if (!is_sample && samples[i] != T{kUntouched}) return false;
      if (++within < step) continue;
      within = 0;
      ++pixel;
    }
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

Canvas::Canvas(int width, int height, bool with_capture, SampleLayout layout) {
  const auto plane_of = [&](auto& samples, int step) {
    const int stride = step * (width + kPadding);
    samples.assign(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height), kUntouched);
    return Plane<typename std::decay_t<decltype(samples)>::value_type>{samples.data(), stride, step};
  };
  const bool gaps = layout == SampleLayout::gaps;
  target.width = width;
  target.height = height;
  for (std::size_t i = 0; i < 4; ++i) {
    if (layout == SampleLayout::words && i > 0) {
      target.color[i] = target.color[0];
      target.color[i].data += i;
    } else {
      target.color[i] = plane_of(color_[i], layout == SampleLayout::words ? 4 : gaps ? 3 : 1);
    }
  }
  target.depth = plane_of(depth_, gaps ? 2 : 1);
  target.stencil = plane_of(stencil_, gaps ? 5 : 1);
  primitive_plane_ = plane_of(primitive_, gaps ? 2 : 1);
  captured_plane_ = plane_of(captured_, gaps ? 3 : 1);
  whole_ = target;
  target.outputs.push_back({.source = OutputSource::primitive, .plane = primitive_plane_});
  if (with_capture) {
    target.outputs.push_back({.source = OutputSource::output_code,
                              .component = kRed,
                              .time = OutputTime::at_depth_pass,
                              .plane = captured_plane_});
  }
}

oracle::Picture Canvas::picture() const {
  oracle::Picture p;
  p.width = target.width;
  p.height = target.height;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const auto& color = whole_.color;
      p.color.push_back({color[0].at(x, y), color[1].at(x, y), color[2].at(x, y), color[3].at(x, y)});
      p.depth.push_back(whole_.depth.at(x, y));
      p.stencil.push_back(whole_.stencil.at(x, y));
      p.primitive.push_back(primitive_plane_.at(x, y));
      p.captured.push_back(captured_plane_.at(x, y));
    }
  }
  return p;
}

void Canvas::load(const oracle::Picture& p) {
  std::size_t from = 0;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x, ++from) {
      for (std::size_t i = 0; i < 4; ++i) whole_.color[i].at(x, y) = p.color[from][i];
      whole_.depth.at(x, y) = p.depth[from];
      whole_.stencil.at(x, y) = p.stencil[from];
      primitive_plane_.at(x, y) = p.primitive[from];
      captured_plane_.at(x, y) = static_cast<s9>(p.captured[from]);
    }
  }
}

bool Canvas::padding_is_whole() const {
  const int width = whole_.width;
  bool whole = is_padding_whole(depth_, whole_.depth, width) && is_padding_whole(stencil_, whole_.stencil, width) &&
               is_padding_whole(primitive_, primitive_plane_, width) &&
               is_padding_whole(captured_, captured_plane_, width);
  const std::size_t group = color_[1].empty() ? 4 : 1;
  for (std::size_t i = 0; i < 4; ++i) whole = whole && is_padding_whole(color_[i], whole_.color[i], width, group);
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

Mesh level_triangle(float z) {
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-3, -3), glm::vec2(5, -3), glm::vec2(-3, 5)}) mesh.add({p, z});
  mesh.add_triangle(0, 1, 2);
  return mesh;
}

PipelineState counting_state() {
  PipelineState state;
  state.color_mask = {false, false, false, false};
  state.stencil_test.enabled = true;
  state.stencil_test.front.depth_pass = StencilOperation::incr;
  return state;
}

Surface drawn_surface(int width, int height, const PipelineState& state, const VertexArrays& arrays,
                      std::span<const TextureUnit> units, const SurfaceFormat& format, const glm::mat4& matrix) {
  Surface surface = Surface::make(width, height, format).value();
  RenderTarget target = surface.target();
  const Status status = rasterize(state, matrix, arrays, units, target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return surface;
}

PlaneSamples<std::uint8_t> coverage(const Mesh& mesh, const glm::mat4& matrix, int width, int height, CullFace cull) {
  PipelineState state = counting_state();
  state.cull_face = cull;
  return drawn_surface(width, height, state, mesh.arrays(), {}, {}, matrix).stencil();
}

glm::dvec3 weights_at(std::span<const glm::vec3> corners, double x, double y, int width, int height, double tangent) {
  const glm::dvec3 ray((x / width * 2 - 1) * tangent * width / height, (y / height * 2 - 1) * tangent, -1);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 w(glm::dot(ray, glm::cross(b, c)), glm::dot(ray, glm::cross(c, a)), glm::dot(ray, glm::cross(a, b)));
  return w / (w.x + w.y + w.z);
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
