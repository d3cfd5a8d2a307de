// Output planes: what each source leaves, when, and what a target may not ask for.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/raster/fragment_support.h"
#include "src/raster/fragment/output_planes.h"
#include "src/raster/surface/target_check.h"

namespace ninebit::test {
namespace {

// A batch of three fragments on two pixels of which the last passes the depth test only, and one pixel left alone.
class Batch {
 public:
  Batch() {
    for (std::size_t i = 0; i < 3; ++i) {
      registers_(Register::spare0, kGreen)[i] = static_cast<s9>(-100 - static_cast<int>(i));
      registers_(Register::texture1, kAlpha)[i] = static_cast<s9>(200 + i);
      output_.plane[kBlue][i] = static_cast<s9>(50 + i);
      values_[i] = 0.5F + static_cast<float>(i);
    }
  }

  BatchResults results() const {
    BatchResults r{
        .fragments = fragments_, .outcomes = fates_, .registers = &registers_, .output = &output_, .colors = colors_};
    r.attributes[2][kAlpha] = values_;
    return r;
  }

 private:
  const std::vector<UncoloredFragment> fragments_{{.x = 0, .depth = 70000, .primitive = 7},
                                                  {.x = 1, .depth = 11, .primitive = 8},
                                                  {.x = 1, .depth = 12, .primitive = 9}};
  const std::vector<FragmentOutcome> fates_{{true, true}, {true, true}, {true, false}};
  const std::vector<ColorBytes> colors_{{1, 2, 3, 4}, {11, 12, 13, 14}, {21, 22, 23, 24}};
  RegisterBatch registers_{};
  OutputBatch output_{};
  float values_[3];
};

// A plane of three samples that starts with `start`, after the batch.
template <class T>
std::vector<T> left_in(OutputPlane output, T start) {
  std::vector<T> samples(3, start);
  output.plane = Plane<T>{samples.data(), 3};
  RenderTarget target;
  target.width = 3;
  target.height = 1;
  target.format = output.source == OutputSource::depth && sizeof(T) == 2 ? DepthStencilFormat::d16 : target.format;
  target.outputs = {output};
  const Status status = check_target({}, target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  static const Batch batch;
  OutputPlanes(target).write(batch.results());
  return samples;
}

TEST(Outputs, EachSourceInEachOfItsSamples) {
  using Source = OutputSource;
  constexpr OutputTime kDepth = OutputTime::at_depth_pass;
  EXPECT_EQ(left_in<s9>({.source = Source::register_code, .reg = Register::spare0, .component = kGreen}, 5),
            (std::vector<s9>{-100, -101, 5}));
  EXPECT_EQ(
      left_in<s9>({.source = Source::register_code, .reg = Register::texture1, .component = kAlpha, .time = kDepth}, 5),
      (std::vector<s9>{200, 202, 5}));
  EXPECT_EQ(left_in<s9>({.source = Source::output_code, .component = kBlue}, 5), (std::vector<s9>{50, 51, 5}));
  EXPECT_EQ(left_in<std::uint8_t>({.source = Source::output_code, .component = kBlue, .time = kDepth}, 5),
            (std::vector<std::uint8_t>{3, 23, 5}));
  EXPECT_EQ(left_in<float>({.source = Source::attribute, .attribute = 2, .component = kAlpha}, 5.0F),
            (std::vector<float>{0.5F, 1.5F, 5.0F}));
  EXPECT_EQ(left_in<Half>({.source = Source::attribute, .attribute = 2, .component = kAlpha, .time = kDepth}, Half{5}),
            (std::vector<Half>{half_of(0.5F), half_of(2.5F), Half{5}}));
  EXPECT_EQ(left_in<std::uint32_t>({.source = Source::primitive}, 5), (std::vector<std::uint32_t>{7, 8, 5}));
  EXPECT_EQ(left_in<std::uint32_t>({.source = Source::primitive, .time = kDepth}, 5),
            (std::vector<std::uint32_t>{7, 9, 5}));
  EXPECT_EQ(left_in<std::uint32_t>({.source = Source::depth}, 5), (std::vector<std::uint32_t>{70000, 11, 5}));
  EXPECT_EQ(left_in<std::uint16_t>({.source = Source::depth, .time = kDepth}, 5),
            (std::vector<std::uint16_t>{70000 - 65536, 12, 5}));
}

// A fragment whose planes need no batch leaves the same in them.
TEST(Outputs, OfAFragmentAlone) {
  std::vector<std::uint32_t> numbers(2, 5);
  std::vector<std::uint16_t> depths(2, 5);
  RenderTarget target;
  target.width = 2;
  target.height = 1;
  target.format = DepthStencilFormat::d15s1;
  target.outputs = {{.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{numbers.data(), 2}},
                    {.source = OutputSource::depth,
                     .time = OutputTime::at_depth_pass,
                     .plane = Plane<std::uint16_t>{depths.data(), 2}}};
  PipelineState state;
  state.alpha_test = {true, CompareFunction::greater, 100};
  const FragmentOperations operations(state, target);
  const OutputPlanes outputs(target);
  EXPECT_TRUE(outputs.need_fragment_alone());
  draw_fragment(operations, outputs, {.x = 0, .depth = 30000, .primitive = 77}, {0, 0, 0, 101});
  draw_fragment(operations, outputs, {.x = 1, .depth = 30001, .primitive = 78}, {0, 0, 0, 100});
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{77, 5}));
  EXPECT_EQ(depths, (std::vector<std::uint16_t>{30000, 30001}));
}

TEST(Outputs, SayWhatTheyNeed) {
  std::uint8_t byte = 0;
  s9 code = 0;
  float real = 0;
  const auto planes_of = [](const OutputPlane& output) {
    RenderTarget target;
    target.outputs = {output};
    return OutputPlanes(target);
  };
  EXPECT_TRUE(planes_of({.source = OutputSource::register_code, .plane = Plane<s9>{&code, 1}}).needs_registers());
  EXPECT_TRUE(planes_of({.source = OutputSource::output_code, .plane = Plane<s9>{&code, 1}}).needs_output());
  const OutputPlanes bytes = planes_of({.source = OutputSource::output_code, .plane = Plane<std::uint8_t>{&byte, 1}});
  EXPECT_TRUE(bytes.needs_colors());
  EXPECT_FALSE(bytes.needs_output() || bytes.needs_registers() || bytes.need_fragment_alone());
  const OutputPlanes reals =
      planes_of({.source = OutputSource::attribute, .attribute = 3, .plane = Plane<float>{&real, 1}});
  EXPECT_TRUE(reals.needs_attribute(3));
  EXPECT_FALSE(reals.needs_attribute(0) || reals.need_fragment_alone());
  // A plane without samples needs nothing.
  const OutputPlanes none = planes_of({.source = OutputSource::attribute, .plane = Plane<float>{}});
  EXPECT_TRUE(none.empty() && none.need_fragment_alone() && !none.needs_attribute(0));
}

class TargetCheck : public testing::Test {
 protected:
  TargetCheck() {
    target_.width = 4;
    target_.height = 2;
  }
  void expect(const std::string& message) const {
    const Status status = check_target(state_, target_);
    if (message.empty()) {
      EXPECT_TRUE(status.ok()) << status.error().message;
      return;
    }
    ASSERT_FALSE(status.ok()) << message;
    EXPECT_EQ(status.error().message, message);
    EXPECT_EQ(status.error().fault, Fault::invalid_input);
  }
  void expect(const OutputPlane& output, const std::string& message) {
    target_.outputs = {OutputPlane{.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{}}, output};
    expect(message);
    target_.outputs.clear();
  }
  PipelineState state_;
  RenderTarget target_;
};

TEST_F(TargetCheck, SamplesHoldTheirSource) {
  using Source = OutputSource;
  const auto with = [](Source source, OutputSamples samples) {
    return OutputPlane{.source = source, .plane = samples};
  };
  expect(with(Source::register_code, Plane<std::uint8_t>{}),
         "output plane 1 stores register codes in 8-bit samples; expected s9 samples");
  expect(with(Source::output_code, Plane<float>{}),
         "output plane 1 stores output codes in float samples; expected s9 or 8-bit samples");
  expect(with(Source::attribute, Plane<s9>{}),
         "output plane 1 stores attributes in s9 samples; expected half or float samples");
  expect(with(Source::primitive, Plane<std::uint16_t>{}),
         "output plane 1 stores primitive numbers in 16-bit samples; expected 32-bit samples");
  expect(with(Source::depth, Plane<std::uint16_t>{}),
         "output plane 1 stores depth codes in 16-bit samples; expected 32-bit samples");
  expect(with(Source::depth, Plane<std::uint32_t>{}), "");
  for (const DepthStencilFormat format : {DepthStencilFormat::d16, DepthStencilFormat::d15s1}) {
    target_.format = format;
    expect(with(Source::depth, Plane<std::uint16_t>{}), "");
    expect(with(Source::depth, Plane<Half>{}),
           "output plane 1 stores depth codes in half samples; expected 16-bit or 32-bit samples");
  }
  expect(with(static_cast<Source>(9), Plane<s9>{}), "output plane 1 has an invalid source");
}

TEST_F(TargetCheck, RangesOfOutputPlanes) {
  for (const int component : {-1, 4}) {
    expect({.source = OutputSource::output_code, .component = component, .plane = Plane<s9>{}},
           "output plane 1 stores component " + std::to_string(component) + "; expected 0 to 3");
    expect({.source = OutputSource::primitive, .component = component, .plane = Plane<std::uint32_t>{}}, "");
  }
  for (const int attribute : {-1, kMaxAttributes}) {
    expect({.source = OutputSource::attribute, .attribute = attribute, .plane = Plane<float>{}},
           "output plane 1 stores attribute " + std::to_string(attribute) + "; expected 0 to 3");
  }
  for (const Register reg : {Register::zero, Register::constant0, Register::constant1, Register::e_times_f,
                             Register::spare0_plus_secondary, Register::discard}) {
    expect({.source = OutputSource::register_code, .reg = reg, .plane = Plane<s9>{}},
           "output plane 1 stores register " + std::string(name_of(reg)) + ", which has no value per fragment");
  }
  for (const Register reg : {Register::fog, Register::primary, Register::texture3}) {
    expect({.source = OutputSource::register_code, .reg = reg, .plane = Plane<s9>{}}, "");
  }
  target_.outputs.resize(kMaxOutputPlanes, {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{}});
  expect("");
  target_.outputs.push_back(target_.outputs.back());
  expect("the target has 33 output planes; there are at most 32");
}

TEST_F(TargetCheck, AttributesAreThere) {
  float real = 0;
  const std::vector<glm::vec3> positions(3);
  const std::vector<glm::vec4> values(3);
  VertexArrays arrays{.positions = positions};
  arrays.attributes[1] = values;
  for (const int attribute : {1, 0}) {
    target_.outputs = {{.source = OutputSource::attribute, .attribute = attribute, .plane = Plane<float>{&real, 4}}};
    const Status status = check_output_attributes(target_, arrays);
    EXPECT_EQ(status.ok(), attribute == 1);
    if (!status.ok()) {
      EXPECT_EQ(status.error().message, "output plane 0 stores attribute 0, which the vertices do not have");
    }
  }
}

TEST_F(TargetCheck, PlanesThatTheStateNeeds) {
  std::vector<std::uint8_t> bytes(8);
  std::vector<std::uint32_t> depths(8);
  state_.stencil_test.enabled = true;
  expect("the stencil test needs a stencil plane");
  target_.format = DepthStencilFormat::d15s1;
  expect("the stencil test needs a stencil plane");
  target_.format = DepthStencilFormat::d16;
  expect("");
  state_.depth_test.enabled = true;
  expect("the depth test needs a depth plane");
  target_.depth = {depths.data(), 4};
  expect("");
  target_.depth.stride = -4;  // the highest row first
  expect("");
  target_.depth.stride = 3;
  expect("the depth plane has overlapping rows: a stride of 3 samples, rows of 4");
  target_.depth.stride = 4;
  target_.stencil = {bytes.data(), -3};
  expect("the stencil plane has overlapping rows: a stride of -3 samples, rows of 4");
  target_.stencil.stride = -4;
  expect("");
  target_.stencil = {bytes.data(), 9, 3};
  expect("the stencil plane has overlapping rows: a stride of 9 samples, rows of 10");
  target_.stencil = {bytes.data(), 10, 0};
  expect("the stencil plane has a step of 0 samples between pixels; expected 1 to 4096");
  target_.stencil = {bytes.data(), 10, 3};
  expect("");
  target_.color[1] = {bytes.data(), 0};
  expect("the green plane has overlapping rows: a stride of 0 samples, rows of 4");
  target_.height = 1;
  expect("");
}

TEST_F(TargetCheck, NumbersOfTheState) {
  state_.scissor = PixelRect{-5, -5, 0, 100000};
  expect("");
  state_.scissor->height = -1;
  expect("the scissor is 0x-1; its sides must not be negative");
  state_.scissor.reset();
  target_.width = 0;
  expect("the render target is 0x2; each side must be from 1 to 16384");
  target_.width = kMaxSurfaceSize + 1;
  expect("the render target is 16385x2; each side must be from 1 to 16384");
}

}  // namespace
}  // namespace ninebit::test
