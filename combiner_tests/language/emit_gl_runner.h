// Runs emitted GLSL on a GL without a window: EGL's surfaceless platform, which Mesa has everywhere.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/language/glsl.h"

namespace ninebit::test {

class GlRunner {
 public:
  // nullptr, and why, where there is no EGL or it offers no such context. `language` is one of GLSL.
  static std::unique_ptr<GlRunner> make(PixelLanguage language, std::string& why_not);
  static std::unique_ptr<GlRunner> make(GlslVersion version, std::string& why_not);
  virtual ~GlRunner() = default;

  [[nodiscard]] virtual std::string renderer() const = 0;

  // What each of the functions (at most 16) of the shader text returns for each of the registers (at most 1024),
  // function by function; empty, with a message, where the shader does not compile or GL reports an error.
  using Colors = std::vector<std::vector<Rgba9>>;
  virtual std::optional<Colors> run(const std::string& source, const std::vector<std::string>& functions,
                                    const std::vector<RegisterFile>& inputs, std::string& message) = 0;
};

}  // namespace ninebit::test
