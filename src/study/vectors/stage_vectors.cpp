#include "ninebit/study/stage_vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/xbox/stage_words.h"
#include "src/study/vectors/stage_groups.h"
#include "src/study/vectors/stage_mistakes.h"
#include "src/study/vectors/vector_words.h"

namespace ninebit {
namespace {

using vectors::Maker;
using vectors::StageGroup;

// The texel of a coordinate of 0 to 1, or, of a rectangle, of 0 to `size`.
int texel_at(float coordinate, int size, bool is_rectangle) {
  const float place = is_rectangle ? coordinate : coordinate * static_cast<float>(size);
  if (!(place > 0.0F)) return 0;
  return place < static_cast<float>(size) ? static_cast<int>(place) : size - 1;
}

// Rule 41: the face of a direction, s and t on it.
struct FacePlace {
  int face;
  float s, t;
};
FacePlace face_of(const std::array<float, 3>& d) {
  const float x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]);
  const auto on = [](int face, float s, float t, float major) {
    return FacePlace{face, (s / major + 1.0F) * 0.5F, (t / major + 1.0F) * 0.5F};
  };
  if (x >= y && x >= z) return d[0] >= 0.0F ? on(0, -d[2], -d[1], x) : on(1, d[2], -d[1], x);
  if (y >= z) return d[1] >= 0.0F ? on(2, d[0], d[2], y) : on(3, d[0], -d[2], y);
  return d[2] >= 0.0F ? on(4, d[0], -d[1], z) : on(5, -d[0], -d[1], z);
}

// Numbers moved by some units in their last places: up, down, and in turn.
float moved(float number, std::size_t place, int way) {
  constexpr float kStep = 4e-6F;
  const bool is_up = way < 2 ? way == 0 : (place + static_cast<std::size_t>(way)) % 2 == 0;
  return number * (is_up ? 1.0F + kStep : 1.0F - kStep);
}

// Whether a fragment gives the same if its numbers are a little larger or smaller.
bool is_steady(const StageVectorPack& pack, const StageVectorProgram& program, const StageCoordinates& at,
               const StageOutput& expected) {
  for (int way = 0; way < 4; ++way) {
    StageCoordinates near = at;
    TextureShaderState state = program.state;
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) near[i][k] = moved(at[i][k], i + k, way);
      TextureStage& stage = state.stage[i];
      for (std::size_t k = 0; k < 4; ++k) stage.matrix[k] = moved(stage.matrix[k], k, way);
      stage.scale = moved(stage.scale, 0, way);
      stage.bias = moved(stage.bias, 1, way);
    }
    const TextureShaderProgram compiled = vectors::compiled_stages(pack.profile, pack.pictures, program, state);
    if (vectors::stage_output(pack.profile, pack.pictures, program, compiled, near) != expected) return false;
  }
  return true;
}

void add_fragments(const StageVectorPack& pack, vectors::VectorRandom& random, StageVectorProgram& program) {
  const TextureShaderProgram compiled = vectors::compiled_stages(pack.profile, pack.pictures, program, program.state);
  program.at.clear();
  program.expected.clear();
  while (program.at.size() < pack.fragments) {
    const StageCoordinates at = vectors::random_coordinates(random, program.state);
    const StageOutput output = vectors::stage_output(pack.profile, pack.pictures, program, compiled, at);
    if (!is_steady(pack, program, at, output)) continue;
    program.at.push_back(at);
    program.expected.push_back(output);
  }
}

// The words' names in the order of a pack.
std::vector<std::string> stage_word_names() {
  std::vector<std::string> names;
  for (const std::string_view name : kOtherWordNames) {
    if (xbox::is_stage_word(name)) names.emplace_back(name);
  }
  TextureShaderState all = vectors::stage_state();
  for (const RegisterWord& word : xbox::encode_stage_numbers(all)) names.push_back(word.name);
  for (int i = 0; i < kTextureStages; ++i) names.push_back("TEXTURE_FILTER[" + std::to_string(i) + ']');
  return names;
}

// NV097_SET_TEXTURE_FILTER's flags of signed components.
std::uint32_t filter_word(const std::array<bool, 4>& is_signed) {
  constexpr std::array kBits{29, 30, 31, 28};  // red, green, blue, alpha
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= static_cast<std::uint32_t>(is_signed[k]) << kBits[k];
  return word;
}

Status set_words(const StageVectorPack& pack, StageVectorProgram& program) {
  program.words.assign(pack.word_names.size(), 0);
  const auto put = [&](const RegisterWord& word) {
    const auto at = std::find(pack.word_names.begin(), pack.word_names.end(), word.name);
    program.words[static_cast<std::size_t>(at - pack.word_names.begin())] = word.value;
  };
  const auto words = xbox::encode_stage_words(xbox::without_kinds(program.state));
  if (!words) return words.error();
  for (const RegisterWord& word : *words) put(word);
  for (const RegisterWord& word : xbox::encode_stage_numbers(program.state)) put(word);
  for (std::size_t i = 0; i < program.is_signed.size(); ++i) {
    put({"TEXTURE_FILTER[" + std::to_string(i) + ']', filter_word(program.is_signed[i]), {}});
  }
  return {};
}

Status make_stage_program(const StageVectorPack& pack, const StageGroup& group, std::uint64_t index, std::size_t number,
                          StageVectorProgram& program) {
  Maker maker(pack.profile, pack.seed, index, number);
  program.state = vectors::stage_state();
  group.make(maker, program);
  program.state = only_used(program.state);
  add_fragments(pack, maker.random, program);
  return set_words(pack, program);
}

}  // namespace

const Bytes4& StagePicture::at(const std::array<float, 3>& place) const {
  float s = place[0], t = place[1];
  int layer = 0;
  if (target == StageTarget::cube_map) {
    const FacePlace on = face_of(place);
    s = on.s;
    t = on.t;
    layer = on.face;
  } else if (target == StageTarget::three_dimensional) {
    layer = texel_at(place[2], depth, false);
  }
  const bool is_rectangle = target == StageTarget::rectangle;
  return texels[static_cast<std::size_t>((layer * height + texel_at(t, height, is_rectangle)) * width +
                                         texel_at(s, width, is_rectangle))];
}

int least_stage_vector_programs() {
  return static_cast<int>(vectors::stage_groups_of_packs().size());
}

Result<StageVectorPack> make_stage_vector_pack(const HardwareProfile& profile, const VectorSettings& settings,
                                               const VectorProgress& go_on) {
  if (!profile.texture_shaders) {
    return Diagnostic{.message = no_texture_shaders(profile)};
  }
  const auto groups = vectors::stage_groups_of_packs();
  if (Status checked = vectors::check_settings(settings, groups.size(), profile); !checked) return checked.error();
  StageVectorPack pack;
  pack.profile = profile;
  pack.seed = settings.seed;
  pack.fragments = static_cast<std::size_t>(settings.fragments);
  pack.word_names = stage_word_names();
  pack.pictures = vectors::stage_pictures(settings.seed);
  if (Status made = vectors::make_programs(pack, groups, settings, go_on, &make_stage_program); !made)
    return made.error();
  return pack;
}

std::vector<StageVectorMistake> stage_vector_mistakes(const HardwareProfile& profile) {
  std::vector<StageVectorMistake> found;
  for (const vectors::StageMistake& one : vectors::stage_mistakes_of(profile)) {
    found.push_back({one.name, one.rules, one.group});
  }
  return found;
}

std::vector<StageOutput> mistaken_outputs(const StageVectorPack& pack, std::size_t mistake,
                                          const StageVectorProgram& program) {
  return vectors::run_stage_mistake(vectors::stage_mistakes_of(pack.profile)[mistake], pack, program);
}

}  // namespace ninebit
