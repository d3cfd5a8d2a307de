// What runs in a browser: computes with every room of it and prints hashes, a line of NAME and HASH each. All builds
// print the same. With --rates prints how fast it is instead: a line of NAME and a number each.
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/effect/effect_renderer.h"
#include "ninebit/effect/generated_meshes.h"
#include "ninebit/effect/generated_textures.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/rc10.h"
#include "src/bench/programs.h"

namespace {

using namespace ninebit;
using Clock = std::chrono::steady_clock;

// FNV-1a.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  template <class T>
  void add_all(const T& samples) {
    for (const auto sample : samples) {
      for (std::size_t i = 0; i < sizeof sample; ++i) {
        value_ = (value_ ^ ((static_cast<std::uint64_t>(sample) >> (8 * i)) & 255U)) * 0x100000001b3U;
      }
    }
  }
  void print(const std::string& name) const {
    std::printf("%s %016llx\n", name.c_str(), static_cast<unsigned long long>(value_));
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void put(RegisterBatch& batch, std::size_t fragment, const RegisterFile& registers) {
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) batch.plane[r][c][fragment] = static_cast<s9>(registers.value[r][c]);
  }
}

// Colours and registers of random fragments, by the batch evaluator and, for a few, by the reference.
void add_fragments(test::Random& random, const Program& program, const HardwareProfile& profile, Hash& hash) {
  constexpr std::size_t kFragments = 32;
  const BatchProgram batch(program, {.registers = true});
  auto registers = std::make_unique<RegisterBatch>();
  auto out = std::make_unique<OutputBatch>();
  std::vector<RegisterFile> files;
  for (std::size_t i = 0; i < kFragments; ++i) {
    files.push_back(test::random_registers(random, profile));
    put(*registers, i, files.back());
  }
  batch.run(*registers, kFragments, *out);
  for (std::size_t i = 0; i < kFragments; ++i) {
    for (const auto& plane : out->plane) hash.add_all(std::array{plane[i]});
    for (const Register r : {Register::spare0, Register::spare1, Register::texture0}) {
      for (int c = 0; c < 4; ++c) hash.add_all(std::array{(*registers)(r, c)[i]});
    }
  }
  for (std::size_t i = 0; i < 2; ++i) hash.add_all(evaluate_fragment(program, files[i]).color);
}

// Every form of a program, as text; what each form reads back.
void add_texts(const CombinerState& state, const HardwareProfile& profile, Hash& hash) {
  const auto add = [&](ProgramForm form, const Result<std::string>& text) {
    hash.add(text ? *text : text.error().message);
    if (!text) return;
    const auto again = parse_program({*text, "text"}, form, profile);
    hash.add(again ? print_json_program(again->state) : again.faults()[0].message);
  };
  add(ProgramForm::json, Result<std::string>(print_json_program(state)));
  add(ProgramForm::gl, print_gl_calls(state, profile));
  add(ProgramForm::rc10, print_rc10(state, profile));
  add(ProgramForm::words, print_register_words(state, chip_of(profile), profile));
  const Program program = normalize(state, profile);
  hash.add(print_explanation(explain(program, profile)));
  const auto glsl = emit_glsl(program, GlslVersion::es_300);
  hash.add(glsl ? *glsl : glsl.error().message);
  const auto c = emit_c(program);
  hash.add(c ? *c : c.error().message);
}

void random_programs(int count) {
  constexpr int kGroup = 1000;
  Hash values, texts;
  for (int i = 0; i < count; ++i) {
    test::Random random(1, static_cast<std::uint64_t>(i));
    const HardwareProfile profile = test::random_profile(random);
    const CombinerState state = test::random_state(random, profile);
    add_fragments(random, normalize(state, profile), profile, values);
    if (i % 10 == 0) add_texts(state, profile, texts);
    if ((i + 1) % kGroup == 0) {
      values.print("programs " + std::to_string(i + 1));
      texts.print("texts " + std::to_string(i + 1));
    }
  }
}

EffectReaders readers() {
  EffectReaders out;
  out.program = [](const std::filesystem::path& file, const HardwareProfile& profile) -> Result<TextProgram> {
    const std::string text = text_of(file);
    const auto program = parse_program({text, file.string()}, form_of(text), profile);
    if (!program) return Diagnostic{.message = program.faults()[0].message};
    return *program;
  };
  out.texture = [](std::span<const std::filesystem::path> files, const HardwareProfile&) -> Result<Texture> {
    return files.size() == 6 ? normalization_cube_map(64) : checkerboard(256);
  };
  out.scene = [](const std::filesystem::path&, std::optional<UpAxis>) { return generated_mesh("torus:48"); };
  return out;
}

// The gallery's effects, with generated pictures and meshes in place of files.
Result<EffectRenderer> renderer_of(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  auto effect = parse_effect({text, file.string()});
  if (!effect) return Diagnostic{.message = effect.faults()[0].message};
  effect->folder = file.parent_path().string();
  const HardwareProfile* const profile = find_profile(effect->profile);
  return EffectRenderer::make(*effect, profile != nullptr ? *profile : profiles::geforce2, readers());
}

bool draw_effects(const std::vector<std::filesystem::path>& files, bool rates) {
  for (const std::filesystem::path& file : files) {
    auto renderer = renderer_of(file);
    if (!renderer) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), renderer.error().text().c_str());
      return false;
    }
    const std::string name = "effect " + file.stem().string();
    if (!renderer->draw()) return false;
    if (!rates) {
      Hash hash;
      for (int c = 0; c < 4; ++c) hash.add_all(renderer->picture().color(c));
      hash.add_all(renderer->picture().depth());
      hash.print(name);
      continue;
    }
    int frames = 0;
    const auto start = Clock::now();
    for (; seconds_since(start) < 0.5; ++frames) {
      if (!renderer->draw()) return false;
    }
    std::printf("%s %.1f\n", name.c_str(), frames / seconds_since(start));
  }
  return true;
}

// Millions of pixels a second.
void combiner_rates() {
  const auto programs = bench::measured_programs(profiles::geforce2);
  for (const bench::MeasuredProgram& measured : *programs) {
    const BatchProgram batch(normalize(measured.state, measured.profile));
    auto registers = std::make_unique<RegisterBatch>();
    auto out = std::make_unique<OutputBatch>();
    test::Random random(1);
    for (std::size_t i = 0; i < kBatchSize; ++i) put(*registers, i, test::random_registers(random, measured.profile));
    double pixels = 0;
    const auto start = Clock::now();
    for (; seconds_since(start) < 0.5; pixels += 100.0 * kBatchSize) {
      for (int i = 0; i < 100; ++i) batch.run(*registers, kBatchSize, *out);
    }
    std::printf("combiner %s %.1f\n", std::string(measured.name).c_str(), pixels / seconds_since(start) / 1e6);
  }
}

}  // namespace

int main(int count, char** words) {
  const bool rates = count > 1 && std::string_view(words[1]) == "--rates";
  const std::vector<std::filesystem::path> effects(words + (rates ? 2 : 1), words + count);
  if (rates) {
    combiner_rates();
  } else {
    random_programs(20'000);
  }
  return draw_effects(effects, rates) ? 0 : 1;
}
