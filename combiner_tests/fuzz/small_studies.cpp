#include "combiner_tests/fuzz/small_studies.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"
#include "ninebit/study/datapath_error.h"
#include "ninebit/study/depth_packing_error.h"
#include "ninebit/study/exhaustive_sum.h"
#include "ninebit/study/index_steps.h"
#include "ninebit/study/program_error.h"
#include "ninebit/study/shadow_sweep.h"

namespace ninebit::fuzz {
namespace {

template <class T>
T made(Result<T> result) {
  if (!result) std::abort();
  return std::move(result).value();
}

std::unique_ptr<Study> index_steps() {
  IndexStepsOptions options{.profiles = {profiles::geforce2}};
  options.formats = {StudyFormat::channel, StudyFormat::luminance_alpha};
  options.last_step = 4;
  return made(index_steps_study(std::move(options)));
}

std::unique_ptr<Study> depth_packing() {
  DepthPackingOptions options = all_depth_packings();
  options.packings.resize(2);
  options.sets = {DepthSet::bits16, DepthSet::floats};
  return made(make_depth_packing_study(options));
}

std::unique_ptr<Study> whole_program() {
  const auto state = made(index_variant_state(profiles::geforce2, StudyFormat::channel, index_variants().front()));
  ProgramInputs inputs;
  inputs.components = {{Register::primary, 0}, {Register::texture0, 0}};
  return made(program_error_study({.study = "datapath", .profile = "geforce2"}, profiles::geforce2,
                                  made(compile(state, profiles::geforce2)), std::move(inputs)));
}

// Two triangles above each other.
std::unique_ptr<Study> shadows() {
  Scene scene;
  scene.positions = {{-4, 0, -4}, {4, 0, -4}, {0, 0, 4}, {-1, 1, -1}, {1, 1, -1}, {0, 1, 1}};
  scene.normals.assign(scene.positions.size(), {0, 1, 0});
  scene.triangles = {{0, 2, 1}, {3, 5, 4}};
  scene.triangle_object = {0, 1};
  scene.triangle_material = {0, 0};
  scene.objects = {{.name = "floor", .first_triangle = 0, .triangle_count = 1},
                   {.name = "roof", .first_triangle = 1, .triangle_count = 1}};
  scene.materials.resize(1);
  scene.cameras = {Camera{.position = {3, 4, 5}}};
  scene.lights = {Light{.name = "", .position = {0.5F, 3, 0.25F}}};
  RenderSettings settings;
  settings.width = settings.height = 16;
  const ShadowGrid grid{{"map-size", {"8", "16"}}, {"index-step", {"1", "2"}}};
  return made(make_shadow_sweep({.study = "shadows", .profile = "geforce2"}, std::move(scene),
                                *find_technique("index-cube"), settings, grid));
}

}  // namespace

const std::vector<std::unique_ptr<Study>>& small_studies() {
  static const std::vector<std::unique_ptr<Study>> studies = [] {
    std::vector<std::unique_ptr<Study>> all;
    all.push_back(index_steps());
    all.push_back(made(datapath_study({.study = "datapath", .profile = "geforce2"}, {&profiles::geforce2, 1})));
    all.push_back(made(exhaustive_sum_study({.study = "datapath", .profile = "geforce2"}, profiles::geforce2,
                                            std::span(kOutputForms).first(1))));
    all.push_back(whole_program());
    all.push_back(depth_packing());
    all.push_back(shadows());
    return all;
  }();
  return studies;
}

std::vector<StudyRow> rows_by_rules(const Study& study, std::size_t unit, double share) {
  std::vector<StudyRow> rows;
  for (const RowRule& rule : study.row_rules(unit)) {
    StudyRow& row = rows.emplace_back(StudyRow{.table = rule.table, .fields = {}});
    for (const FieldRule& field : rule.fields) {
      const double number = field.least + share * (field.greatest - field.least);
      StudyValue value;
      switch (field.kind) {
        case FieldRule::Kind::exact:
          value = field.value;
          break;
        case FieldRule::Kind::count:
        case FieldRule::Kind::whole:
          value = static_cast<std::int64_t>(std::min(number, 0x1p62));
          break;
        case FieldRule::Kind::real:
          value = number;
          break;
        case FieldRule::Kind::text:
          value = std::string("tex0.r 3");
          break;
      }
      // The reason why there is no result is given exactly where there is none.
      if (field.may_be_nothing && field.kind == FieldRule::Kind::text) value = std::monostate();
      row.fields.emplace_back(field.name, std::move(value));
    }
  }
  return rows;
}

}  // namespace ninebit::fuzz
