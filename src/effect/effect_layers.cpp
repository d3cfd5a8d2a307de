#include "src/effect/effect_layers.h"

#include <array>
#include <utility>

#include "src/frame/camera_frame.h"

namespace ninebit {

void capture_registers(std::deque<Layer>& layers, const std::string& pass, RenderTarget& target) {
  const auto add = [&](OutputSource source, Register reg, int component, const char* part) {
    const std::string channel(1, "RGBA"[component]);
    auto& plane = add_layer<s9>(layers, pass + "." + part, channel, target.width, target.height);
    target.outputs.push_back({.source = source,
                              .reg = reg,
                              .component = component,
                              .time = OutputTime::at_depth_pass,
                              .plane = Plane<s9>{plane.data(), target.width}});
  };
  constexpr std::array<std::pair<Register, const char*>, 4> kRegisters{{{Register::primary, "primary"},
                                                                        {Register::texture0, "texture0"},
                                                                        {Register::spare0, "spare0"},
                                                                        {Register::spare1, "spare1"}}};
  for (int c = 0; c < 4; ++c) {
    for (const auto& [reg, name] : kRegisters) add(OutputSource::register_code, reg, c, name);
    add(OutputSource::output_code, Register::spare0, c, "output");
  }
}

void add_frame_layers(std::deque<Layer>& layers, const Surface& frame) {
  const auto add = [&]<class Sample>(const char* name, const PlaneSamples<Sample>& samples) {
    if (samples.empty()) return;
    auto& layer = add_layer<Sample>(layers, name, name, frame.width(), frame.height());
    layer.assign(samples.begin(), samples.end());
  };
  add("stencil", frame.stencil());
  add("depth", frame.depth());
}

}  // namespace ninebit
