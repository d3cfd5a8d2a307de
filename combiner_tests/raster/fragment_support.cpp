#include "combiner_tests/raster/fragment_support.h"

#include <sstream>

namespace ninebit::test {
namespace {

constexpr std::uint8_t kEdges[] = {0, 1, 127, 128, 254, 255};

// The compare functions and the stencil operations are eight each.
template <class Enum>
Enum any_of_eight(Random& random) {
  return static_cast<Enum>(random.below(8));
}

StencilFace random_face(Random& random) {
  StencilFace face;
  face.function = random.one_in(3) ? CompareFunction::always : any_of_eight<CompareFunction>(random);
  face.reference = random.one_in(8) ? random.pick({-1, 256, 1000, -100000}) : edge_byte(random);
  face.mask = random.one_in(2) ? 0xFF : random.byte();
  face.write_mask = random.one_in(2) ? 0xFF : edge_byte(random);
  face.fail = any_of_eight<StencilOperation>(random);
  face.depth_fail = any_of_eight<StencilOperation>(random);
  face.depth_pass = any_of_eight<StencilOperation>(random);
  // The rasterizer may take short cuts where nothing is written.
  if (random.one_in(3)) face.fail = face.depth_fail = StencilOperation::keep;
  if (random.one_in(3)) face.depth_pass = StencilOperation::keep;
  return face;
}

void describe(std::ostream& out, const StencilFace& f) {
  out << static_cast<int>(f.function) << ' ' << f.reference << " masks " << int{f.mask} << ' ' << int{f.write_mask}
      << " operations " << static_cast<int>(f.fail) << ' ' << static_cast<int>(f.depth_fail) << ' '
      << static_cast<int>(f.depth_pass);
}

}  // namespace

std::uint8_t edge_byte(Random& random) {
  return random.one_in(3) ? random.byte() : kEdges[random.below(6)];
}

void randomize_fragment_operations(Random& random, PipelineState& state) {
  state.alpha_test = {random.one_in(2), any_of_eight<CompareFunction>(random), edge_byte(random)};
  state.stencil_test.enabled = !random.one_in(3);
  state.stencil_test.front = random_face(random);
  state.stencil_test.back.reset();
  if (random.one_in(3)) state.stencil_test.back = random_face(random);
  if (random.one_in(4)) {  // a test that changes nothing
    state.stencil_test.front.write_mask = 0;
    if (state.stencil_test.back) state.stencil_test.back->write_mask = 0;
  }
  state.depth_test = {!random.one_in(3), any_of_eight<CompareFunction>(random), !random.one_in(3)};
  state.blend = {};
  if (random.one_in(3)) {
    state.blend.enabled = true;
    state.blend.source = static_cast<BlendFactor>(random.below(15));
    state.blend.destination = static_cast<BlendFactor>(random.below(14));
    state.blend.equation = random.one_in(2) ? BlendEquation::add : static_cast<BlendEquation>(random.below(7));
    for (std::uint8_t& component : state.blend.color) component = edge_byte(random);
  }
  for (bool& mask : state.color_mask) mask = !random.one_in(6);
  if (random.one_in(8)) state.color_mask = {};
}

ColorFormat random_color_format(Random& random, bool blended) {
  if (random.one_in(2)) return ColorFormat::a8r8g8b8;
  const auto count = static_cast<int>(kColorFormats.size());
  return static_cast<ColorFormat>(random.below(blended ? count - 2 : count));
}

void set_color_format(ColorFormat format, oracle::Picture& picture) {
  picture.color_format = format;
  for (oracle::Bytes& color : picture.color) color = oracle::kept(format, color);
}

StipplePattern random_stipple(Random& random) {
  StipplePattern pattern{};
  for (std::uint8_t& bits : pattern) bits = edge_byte(random);
  return pattern;
}

std::uint32_t some_depth(Random& random, DepthStencilFormat format) {
  const std::uint32_t largest = max_depth(format), middle = largest / 2;
  if (random.one_in(2)) return random.pick({0U, 1U, middle, middle + 1, largest - 1, largest});
  return static_cast<std::uint32_t>(random.next()) & largest;
}

oracle::Picture empty_picture(int width, int height, DepthStencilFormat format) {
  oracle::Picture p{.width = width, .height = height, .format = format};
  const auto count = static_cast<std::size_t>(width * height);
  p.color.resize(count);
  p.depth.resize(count);
  p.stencil.resize(count);
  p.primitive.resize(count);
  p.captured.resize(count);
  return p;
}

oracle::Picture random_picture(Random& random, int width, int height, DepthStencilFormat format) {
  oracle::Picture p = empty_picture(width, height, format);
  for (std::size_t i = 0; i < p.color.size(); ++i) {
    p.color[i] = {edge_byte(random), edge_byte(random), edge_byte(random), edge_byte(random)};
    p.depth[i] = some_depth(random, format);
    p.stencil[i] = edge_byte(random);
    p.primitive[i] = 0xFFFFFFFF;
    p.captured[i] = random.byte();
  }
  return p;
}

PicturePlanes::PicturePlanes(const oracle::Picture& p, bool at_depth_pass)
    : start_(p), depth_(p.depth), primitive_(p.primitive), stencil_(p.stencil) {
  for (const oracle::Bytes& color : p.color) {
    for (std::size_t i = 0; i < 4; ++i) color_[i].push_back(color[i]);
  }
  for (const int captured : p.captured) captured_.push_back(static_cast<std::uint8_t>(captured));
  target.width = p.width;
  target.height = p.height;
  target.color_format = p.color_format;
  target.format = p.format;
  for (std::size_t i = 0; i < (p.has_alpha ? 4U : 3U); ++i) target.color[i] = {color_[i].data(), p.width};
  target.depth = {depth_.data(), p.width};
  if (stencil_bits(p.format) > 0) target.stencil = {stencil_.data(), p.width};
  target.outputs.push_back(
      {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{primitive_.data(), p.width}});
  if (!at_depth_pass) return;
  target.outputs.push_back({.source = OutputSource::output_code,
                            .time = OutputTime::at_depth_pass,
                            .plane = Plane<std::uint8_t>{captured_.data(), p.width}});
}

oracle::Picture PicturePlanes::picture() const {
  oracle::Picture p = start_;
  for (std::size_t at = 0; at < p.color.size(); ++at) {
    for (std::size_t i = 0; i < 4; ++i) p.color[at][i] = color_[i][at];
    p.captured[at] = captured_[at];
  }
  p.depth = depth_;
  p.stencil = stencil_;
  p.primitive = primitive_;
  return p;
}

bool same_samples(const oracle::Picture& a, const oracle::Picture& b) {
  return a.color == b.color && a.depth == b.depth && a.stencil == b.stencil && a.primitive == b.primitive &&
         a.captured == b.captured;
}

std::string describe_operations(const PipelineState& state) {
  std::ostringstream out;
  const AlphaTest& a = state.alpha_test;
  const DepthTest& z = state.depth_test;
  const Blend& b = state.blend;
  out << "alpha " << a.enabled << ' ' << static_cast<int>(a.function) << ' ' << int{a.reference} << ", stencil "
      << state.stencil_test.enabled << ' ';
  describe(out, state.stencil_test.front);
  if (state.stencil_test.back) {
    out << " back ";
    describe(out, *state.stencil_test.back);
  }
  out << ", depth " << z.enabled << ' ' << static_cast<int>(z.function) << " write " << z.write << ", blend "
      << b.enabled << ' ' << static_cast<int>(b.source) << ' ' << static_cast<int>(b.destination) << " equation "
      << static_cast<int>(b.equation) << " colour";
  for (const std::uint8_t component : b.color) out << ' ' << int{component};
  out << ", colour mask ";
  for (const bool mask : state.color_mask) out << mask;
  return out.str();
}

}  // namespace ninebit::test
