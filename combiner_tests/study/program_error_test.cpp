// Errors of whole programs: colours between the real and the ideal one, and what the stages add.
#include "ninebit/study/program_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/study/proof_support.h"
#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/study/datapath_error.h"
#include "ninebit/study/index_steps.h"
#include "src/combiner/given_registers.h"
#include "src/study/datapath/color_inputs.h"
#include "src/study/datapath/program_inputs.h"

namespace {

using namespace ninebit;
using namespace ninebit::test;

Program compiled(const CombinerState& state, const HardwareProfile& profile) {
  const auto program = compile(state, profile);
  if (!program) throw std::runtime_error(program.error().text());
  return *program;
}

// The article's comparison of one channel.
Program comparison(const HardwareProfile& profile) {
  const auto state = index_variant_state(profile, StudyFormat::channel, index_variants()[0]);
  if (!state) throw std::runtime_error(state.error().text());
  return compiled(*state, profile);
}

const StudyRow& row_of(const std::vector<StudyRow>& rows, std::string_view table, std::string_view component,
                       std::uint64_t stage = 0) {
  for (const StudyRow& row : rows) {
    if (row.table == table && row.text("component") == component && row.count("stage") == stage) return row;
  }
  throw std::runtime_error("no such row");
}

// The report on all rows with its maps and files.
StudyReport drawn_report(const Study& study, const std::vector<StudyRow>& rows) {
  auto report = study.report(rows, study.units());
  if (!report) throw std::runtime_error(report.error().text());
  if (Status status = study.draw(rows, {}, *report); !status) throw std::runtime_error(status.error().text());
  return *std::move(report);
}

// The ends and the sum, and each colour between against the trace's codes run through what is left of the state.
TEST(ProgramErrors, StagesAddUpToTheErrorOfRandomPrograms) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  int several = 0, wrong = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Random random(0xE44011, i);
    const HardwareProfile profile = random_profile(random);
    const CombinerState state = random_state(random, profile);
    const Program program = compiled(state, profile);
    const RegisterFile registers = random_registers(random, profile);
    const std::vector<RealColor> colors = colors_by_stage(program, registers);
    const auto n = static_cast<std::size_t>(program.num_general_combiners);
    ASSERT_EQ(colors.size(), n + 2);
    if (n > 1) ++several;

    const RealColor ideal = evaluate_real(program, registers).color;
    const Rgba9 real = evaluate(program, registers);
    const Trace steps = trace(program, profile, registers);
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(colors[0][c], ideal[c], 1e-11) << "program " << i;
      double sum = 0.0;
      for (std::size_t k = 1; k < colors.size(); ++k) sum += colors[k][c] - colors[k - 1][c];
      EXPECT_NEAR(sum, to_real(profile, real[c]) - ideal[c], 1e-10) << "program " << i;
      if (std::fabs(sum) > 1e-6) ++wrong;
    }
    for (std::size_t k = 1; k <= n; ++k) {
      Program rest = program;
      rest.num_general_combiners = static_cast<int>(n - k);
      std::copy(program.general.begin() + static_cast<std::ptrdiff_t>(k), program.general.end(), rest.general.begin());
      const RealColor expected = evaluate_real(rest, steps.stage[k - 1].after.codes).color;
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(colors[k][c], expected[c], 1e-11) << "program " << i << ", stage " << k;
      }
    }
  }
  EXPECT_GT(several, 100);
  EXPECT_GT(wrong, 100);
}

// Eight squarings: the exact numbers outgrow 128 bits.
TEST(ProgramErrors, DeepProgramsStayExact) {
  const HardwareProfile& profile = profiles::nv2a;
  std::string body = "{ rgb { spare0 = col0 * col0; } }\n";
  for (int k = 1; k < 8; ++k) body += "{ rgb { spare0 = spare0 * spare0; } }\n";
  const Program program = compiled(rc10(body + "out.rgb = spare0;\n", profile), profile);
  RegisterFile registers;
  registers[Register::primary] = {254, 253, 200, 0};
  const std::vector<RealColor> colors = colors_by_stage(program, registers);
  ASSERT_EQ(colors.size(), 10U);
  EXPECT_NEAR(colors[0][kRed], std::pow(254.0 / 255.0, 256.0), 1e-11);
  EXPECT_NEAR(colors[0][kGreen], std::pow(253.0 / 255.0, 256.0), 1e-11);
  // A square of 254 codes is 253.004, to nearest 253; and so on.
  EXPECT_NEAR(colors[1][kRed], std::pow(253.0 / 255.0, 128.0), 1e-11);
  EXPECT_NEAR(colors[2][kRed], std::pow(251.0 / 255.0, 64.0), 1e-11);
}

TEST(ProgramErrors, WhatIsNotNamedReadsAsInEval) {
  const HardwareProfile& d = profiles::geforce2;
  const auto alphas = Fragments::of(d, {.components = {{Register::texture0, kAlpha}}, .codes = {}});
  ASSERT_TRUE(alphas.ok());
  EXPECT_EQ(alphas->count(), 256U);
  RegisterFile registers = alphas->registers(7);
  EXPECT_EQ(registers[Register::texture0], (Rgba9{0, 0, 0, 7}));
  EXPECT_EQ(registers[Register::spare0], (Rgba9{0, 0, 0, 7}));
  EXPECT_EQ(registers[Register::texture3], (Rgba9{0, 0, 0, 255}));
  EXPECT_EQ(registers[Register::fog], (Rgba9{0, 0, 0, 255}));
  EXPECT_EQ(registers[Register::primary], Rgba9{});
  const auto own = Fragments::of(
      d, {.components = {{Register::texture0, kAlpha}, {Register::spare0, kAlpha}}, .codes = std::vector<s9>{7, -3}});
  ASSERT_TRUE(own.ok());
  registers = own->registers(0);
  EXPECT_EQ(registers[Register::texture0][kAlpha], 7);
  EXPECT_EQ(registers[Register::spare0][kAlpha], -3);
  // All combinations, the last component fastest; spare0 from -255 on.
  const auto all = Fragments::of(d, {.components = {{Register::fog, kRed}, {Register::spare0, kRed}}, .codes = {}});
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all->count(), 256U * 511U);
  EXPECT_EQ(all->text(0), "fog.r 0, spare0.r -255");
  EXPECT_EQ(all->text(511), "fog.r 1, spare0.r -255");
  EXPECT_EQ(all->text(512), "fog.r 1, spare0.r -254");
}

// All values of two components, each fragment by the reference and by exact numbers.
TEST(ProgramErrors, AllCombinationsMatchDirectEvaluation) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce256_8bit;
  const Program program = comparison(profile);
  const auto study = valid(program_error_study(
      {}, profile, program, {.components = {{Register::primary, kRed}, {Register::texture0, kRed}}, .codes = {}}));
  EXPECT_EQ(study->units(), 1U);
  const std::vector<StudyRow> rows = all_rows(*study);
  EXPECT_EQ(rows.size(), 4U + 4U * 3U + 4U * 17U);

  std::uint64_t exact = 0, misrounded = 0;
  std::map<int, std::uint64_t> histogram;
  std::vector<float> in_codes;
  double most = 0.0, sizes = 0.0, errors = 0.0;
  std::string worst;
  for (int a = 0; a <= 127; ++a) {
    for (int b = 0; b <= 127; ++b) {
      RegisterFile registers;
      for (const Register r : {Register::texture0, Register::texture1, Register::texture2, Register::texture3,
                               Register::fog, Register::spare0}) {
        registers[r][kAlpha] = 127;
      }
      registers[Register::primary][kRed] = static_cast<s9>(a);
      registers[Register::texture0][kRed] = static_cast<s9>(b);
      const double error =
          to_real(profile, evaluate(program, registers)[kAlpha]) - evaluate_real(program, registers).color[kAlpha];
      if (std::fabs(error) < 1e-12) ++exact;
      sizes += std::fabs(error);
      errors += error;
      in_codes.push_back(static_cast<float>(error * 127.0));
      if (std::fabs(error * 127.0) > 0.500001) ++misrounded;
      ++histogram[std::clamp(static_cast<int>(std::lround(error * 127.0)), -8, 8)];
      if (std::fabs(error) > most + 1e-10) {
        most = std::fabs(error);
        worst = "primary.r " + std::to_string(a) + ", tex0.r " + std::to_string(b);
      }
    }
  }
  const StudyRow& alpha = row_of(rows, "rows", "a");
  EXPECT_EQ(alpha.count("fragments"), 128U * 128U);
  EXPECT_EQ(alpha.count("exact"), exact);
  EXPECT_EQ(alpha.count("misrounded"), misrounded);
  EXPECT_GT(misrounded, 0U);
  std::size_t bins = 0;
  for (const StudyRow& row : rows) {
    if (row.table != "histogram" || row.text("component") != "a") continue;
    EXPECT_EQ(row.count("count"), histogram[static_cast<int>(row.number("error_codes"))]) << row.number("error_codes");
    ++bins;
  }
  EXPECT_EQ(bins, 17U);
  EXPECT_NEAR(alpha.number("max_error_codes"), most * 127.0, 1e-9);
  EXPECT_NEAR(alpha.number("mean_error_codes"), sizes * 127.0 / 16384.0, 1e-9);
  EXPECT_NEAR(alpha.number("mean_bias_codes"), errors * 127.0 / 16384.0, 1e-9);
  EXPECT_EQ(alpha.text("worst"), worst);
  EXPECT_GT(most, 0.0);

  // The first stage is exact but for its clamp, which is none of a difference's; the second cuts; the last passes on.
  EXPECT_EQ(row_of(rows, "stages", "a", 1).number("added_max_codes"), 0.0);
  EXPECT_NEAR(row_of(rows, "stages", "a", 2).number("added_mean_codes"), sizes * 127.0 / 16384.0, 1e-9);
  EXPECT_NEAR(row_of(rows, "stages", "a", 2).number("remaining_max_codes"), most * 127.0, 1e-9);
  EXPECT_EQ(row_of(rows, "stages", "a", 3).number("added_max_codes"), 0.0);
  EXPECT_EQ(row_of(rows, "stages", "a", 3).text("name"), "final");

  const StudyReport report = drawn_report(*study, rows);
  ASSERT_EQ(report.heat_maps.size(), 1U);  // alpha's: the colour is 0
  const HeatMap& map = report.heat_maps[0];
  EXPECT_EQ(map.width, 128);
  RegisterFile registers;
  registers[Register::primary][kRed] = 9;
  registers[Register::texture0][kRed] = 4;
  const double error =
      to_real(profile, evaluate(program, registers)[kAlpha]) - evaluate_real(program, registers).color[kAlpha];
  EXPECT_NEAR(map.values[(127 - 4) * 128 + 9], error * 127.0, 1e-5);

  ASSERT_EQ(report.files.size(), 2U);
  const std::string &csv = report.files[0].content, &npy = report.files[1].content;
  EXPECT_EQ(report.files[0].name, "error.csv");
  EXPECT_TRUE(csv.starts_with("primary.r,tex0.r,error.r,error.g,error.b,error.a\n0,0,0,0,0,")) << csv.substr(0, 80);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 128 * 128);
  EXPECT_EQ(report.files[1].name, "error.npy");
  EXPECT_TRUE(npy.starts_with(std::string("\x93NUMPY\x01\x00\x76\x00", 10)));
  EXPECT_NE(npy.find("'descr': '<f4', 'fortran_order': False, 'shape': (128, 128, 4)"), std::string::npos);
  ASSERT_EQ(npy.size(), 128U + in_codes.size() * 4 * sizeof(float));
  for (std::size_t i = 0; i < in_codes.size(); ++i) {
    float value = 0.0F;
    std::memcpy(&value, npy.data() + 128 + (4 * i + 3) * sizeof(float), sizeof value);
    ASSERT_NEAR(value, in_codes[i], 1e-5) << i;
  }
}

// A component that is fixed is that column of a table.
TEST(ProgramErrors, FixedComponentsAreColumnsOfOneValue) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = comparison(profile);
  const RegisterComponent varied{Register::primary, kRed}, fixed{Register::texture0, kRed};
  ProgramInputs table{.components = {varied, fixed}, .codes = std::vector<s9>{}};
  for (int code = 0; code <= 255; ++code) table.codes->insert(table.codes->end(), {static_cast<s9>(code), 100});
  const ProgramInputs given{.components = {varied}, .fixed = {{fixed, 100}}};
  const auto rows = all_rows(*valid(program_error_study({}, profile, program, given)));
  const auto expected = all_rows(*valid(program_error_study({}, profile, program, table)));
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const char* name : {"exact", "misrounded", "max_error_codes", "mean_error_codes", "added_max_codes",
                             "added_bias_codes", "count"}) {
      EXPECT_EQ(rows[i].number(name), expected[i].number(name)) << i << ' ' << name;
    }
  }
  EXPECT_GT(row_of(rows, "rows", "a").number("max_error_codes"), 0.0);
  const ProgramInputs twice{.components = {varied}, .fixed = {{varied, 1}}};
  const auto refused = program_error_study({}, profile, program, twice);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "primary.r is fixed and varied; expected one of them");
  const auto error_of = [&](const ProgramInputs& inputs) {
    return program_error_study({}, profile, program, inputs).error().message;
  };
  EXPECT_EQ(error_of({.components = {varied, fixed, varied}}),
            "primary.r is varied twice; expected each register component once");
  EXPECT_EQ(error_of({.components = {varied, varied}, .codes = std::vector<s9>{1, 2}}),
            "primary.r is varied twice; expected each register component once");
  EXPECT_EQ(error_of({.components = {varied}, .fixed = {{fixed, 100}, {fixed, 100}}}),
            "tex0.r is fixed twice; expected each register component once");
}

TEST(ProgramErrors, BiasesOfStagesAddUpOnAnyProfile) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (std::uint64_t i = 0; i < 12; ++i) {
    Random random(0xB1A5, i);
    const HardwareProfile profile = random_profile(random);
    const Program program = compiled(random_state(random, profile), profile);
    ProgramInputs inputs{.components = {{Register::primary, kGreen},
                                        {Register::spare1, kRed},
                                        {Register::texture1, kAlpha},
                                        {Register::constant0, kBlue}},
                         .codes = std::vector<s9>{}};
    for (int k = 0; k < 4 * 5000; ++k) inputs.codes->push_back(static_cast<s9>(random_code(random, profile)));
    const std::vector<StudyRow> rows = all_rows(*valid(program_error_study({}, profile, program, inputs)));
    for (const char* component : {"r", "g", "b", "a"}) {
      double sum = 0.0;
      const auto stages = static_cast<std::uint64_t>(program.num_general_combiners) + 1;
      for (std::uint64_t k = 1; k <= stages; ++k)
        sum += row_of(rows, "stages", component, k).number("added_bias_codes");
      const StudyRow& total = row_of(rows, "rows", component);
      EXPECT_EQ(total.count("fragments"), 5000U);
      EXPECT_NEAR(sum, total.number("mean_bias_codes"), 1e-8) << "program " << i << ", " << component;
      EXPECT_NEAR(row_of(rows, "stages", component, stages).number("remaining_mean_codes"),
                  total.number("mean_error_codes"), 1e-10);
    }
  }
}

// A table has the fragments of --over: the same rows but for the way they were asked.
TEST(ProgramErrors, ATableOfAllFragmentsIsTheSame) {
  const HardwareProfile& profile = profiles::geforce256_8bit;
  const Program program = comparison(profile);
  const std::vector<RegisterComponent> components{{Register::texture0, kBlue}, {Register::spare0, kRed}};
  ProgramInputs table{.components = components, .codes = std::vector<s9>{}};
  for (int a = 0; a <= 127; ++a) {
    for (int b = -127; b <= 127; ++b) {
      table.codes->push_back(static_cast<s9>(a));
      table.codes->push_back(static_cast<s9>(b));
    }
  }
  const auto rows = all_rows(*valid(program_error_study({}, profile, program, table)));
  EXPECT_EQ(rows, all_rows(*valid(program_error_study({}, profile, program, {.components = components, .codes = {}}))));
  EXPECT_EQ(row_of(rows, "rows", "a").count("fragments"), 128U * 255U);
}

// Every input that changes a component of a random program's colour, in codes or in exact numbers, is among those that
// it depends on; and those that are left out are many.
TEST(ProgramErrors, ColoursDependOnTheInputsThatChangeThem) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  int changed = 0, left_out = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    Random random(0xDE9E4D, i);
    const HardwareProfile profile = random_profile(random);
    const Program program = compiled(random_state(random, profile), profile);
    const std::array<InputSet, 4> depends = inputs_of_color(program, true);
    const RegisterFile before = random_registers(random, profile);
    const std::vector<RealColor> colors = colors_by_stage(program, before);
    for (std::size_t r = 1; r < kRegisterCount; ++r) {
      for (int component = 0; component < 4; ++component) {
        const auto reg = static_cast<Register>(r);
        const auto code = static_cast<s9>(random_code(random, profile));
        RegisterFile after = before;
        after[reg][static_cast<std::size_t>(component)] = code;
        Program with = program;
        if (reg == Register::constant0 || reg == Register::constant1) replace_constant(with, reg, component, code);
        const std::vector<RealColor> others = colors_by_stage(with, after);
        for (std::size_t c = 0; c < 4; ++c) {
          const bool may = depends[c].test(input_bit(reg, component));
          left_out += may ? 0 : 1;
          for (std::size_t k = 0; k < colors.size(); ++k) {
            if (colors[k][c] == others[k][c]) continue;
            ++changed;
            EXPECT_TRUE(may) << "program " << i << ", colour " << c << " of " << k << ", register " << r << '.'
                             << component;
          }
        }
      }
    }
  }
  EXPECT_GT(changed, 1000);
  EXPECT_GT(left_out, 10000);
}

// Red and green of one product each, and alpha a constant; blue reads nothing.
Program products_by_channel(const HardwareProfile& profile) {
  return compiled(rc10("{ rgb { spare0 = col0 * tex0; } }\n"
                       "out.rgb = lerp(unsigned_invert(zero), spare0, fog); out.a = unsigned_invert(zero);\n",
                       profile),
                  profile);
}

// 2^32 combinations whose channels separate: each channel's rows are those of its two inputs alone.
TEST(ProgramErrors, ChannelsThatSeparateAreMeasuredApart) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = products_by_channel(profile);
  const RegisterComponent red[]{{Register::primary, kRed}, {Register::texture0, kRed}};
  const RegisterComponent green[]{{Register::primary, kGreen}, {Register::texture0, kGreen}};
  const ProgramInputs all{.components = {red[0], green[0], red[1], green[1], {Register::fog, kRed}}, .codes = {}};
  const auto study = valid(program_error_study({}, profile, program, all));
  ASSERT_EQ(study->units(), 3U);
  const std::vector<StudyRow> rows = all_rows(*study);
  const auto alone =
      all_rows(*valid(program_error_study({}, profile, program, {.components = {red[0], red[1]}, .codes = {}})));
  EXPECT_EQ(row_of(rows, "rows", "r"), row_of(alone, "rows", "r"));
  EXPECT_EQ(row_of(rows, "stages", "r", 1), row_of(alone, "stages", "r", 1));
  EXPECT_EQ(row_of(rows, "rows", "g").text("over"), "primary.g, tex0.g");
  EXPECT_EQ(row_of(rows, "rows", "g").number("mean_error_codes"),
            row_of(alone, "rows", "r").number("mean_error_codes"));
  for (const char* component : {"b", "a"}) {
    EXPECT_EQ(row_of(rows, "rows", component).text("over"), "none");
    EXPECT_EQ(row_of(rows, "rows", component).count("fragments"), 1U);
  }
  // Nothing is said of a component of the colour by fragments that do not decide it.
  EXPECT_EQ(rows.size(), 4U * (1U + 2U + 17U));
  for (const StudyRow& row : rows) EXPECT_EQ(row.text("over") == "primary.r, tex0.r", row.text("component") == "r");

  const StudyReport report = drawn_report(*study, rows);
  EXPECT_TRUE(report.answers[0].starts_with("red over primary.r, tex0.r: exact for ")) << report.answers[0];
  EXPECT_TRUE(report.answers[1].starts_with("red over primary.r, tex0.r: on average ")) << report.answers[1];
  ASSERT_EQ(report.answers.size(), 7U);
  EXPECT_EQ(report.answers[5], "alpha depends on no input that varies: exact.");
  EXPECT_EQ(report.answers[6], "No component of the colour depends on fog.r.");
  for (const ReportTable& table : report.tables) {
    EXPECT_EQ(table.columns[1], "over");
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  for (const Plot& plot : report.plots) {
    EXPECT_NE(plot.caption.find("red over primary.r, tex0.r; green over primary.g, tex0.g; blue over none"),
              std::string::npos);
  }
  ASSERT_EQ(report.heat_maps.size(), 2U);
  EXPECT_EQ(report.heat_maps[1].title, "Error of green");
  EXPECT_EQ(report.heat_maps[1].x_label, "primary.g, as code");
  ASSERT_EQ(report.files.size(), 4U);
  EXPECT_EQ(report.files[0].name, "error-r.csv");
  EXPECT_TRUE(report.files[0].content.starts_with("primary.r,tex0.r,error.r\n0,0,0\n"));
  EXPECT_NE(report.files[3].content.find("'shape': (256, 256, 1)"), std::string::npos);
}

// All components depend on the same two of four inputs: the report still names them and those that are left out.
TEST(ProgramErrors, OneGroupOfFewerInputsIsNamed) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const CombinerState state = rc10("{ alpha { spare0 = tex0.a * col0.a; } }\nout.rgb = spare0.a; out.a = spare0.a;\n");
  const ProgramInputs all{.components = {{Register::texture0, kAlpha},
                                         {Register::primary, kAlpha},
                                         {Register::texture1, kRed},
                                         {Register::texture1, kGreen}}};
  const HardwareProfile& profile = profiles::geforce2;
  const auto study = valid(program_error_study({}, profile, compiled(state, profile), all));
  ASSERT_EQ(study->units(), 1U);
  EXPECT_EQ(study->unit_name(0), "geforce2, over tex0.a, primary.a, fragments from 0");
  const StudyReport report = drawn_report(*study, all_rows(*study));
  EXPECT_TRUE(report.answers[0].starts_with("red over tex0.a, primary.a: exact for ")) << report.answers[0];
  EXPECT_EQ(report.answers.back(), "No component of the colour depends on tex1.r, tex1.g.");
  EXPECT_EQ(report.tables.at(0).columns.at(1), "over");
  EXPECT_NE(report.plots.at(0).caption.find("alpha over tex0.a, primary.a."), std::string::npos);
  ASSERT_EQ(report.files.size(), 2U);
  EXPECT_EQ(report.files[0].name, "error.csv");
}

// A component over no inputs that is not exact: one half is 128 codes on this profile, exactly 127.5.
TEST(ProgramErrors, AComponentOverNoInputsSaysItsError) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  const CombinerState state = rc10(
      "{ rgb { spare0 = col0 * tex0; } alpha { spare0 = -half_bias(zero) * unsigned_invert(zero); } }\n"
      "out.rgb = spare0; out.a = spare0.a;\n");
  const ProgramInputs all{.components = {{Register::primary, kRed},
                                         {Register::primary, kGreen},
                                         {Register::texture0, kRed},
                                         {Register::texture0, kGreen}}};
  const auto study = valid(program_error_study({}, profile, compiled(state, profile), all));
  const auto report = study->report(all_rows(*study), study->units());
  ASSERT_TRUE(report.ok());
  const std::string expected = "alpha depends on no input that varies: it is 128, exact 127.500, error 0.500 codes.";
  EXPECT_EQ(std::count(report->answers.begin(), report->answers.end(), expected), 1) << report->answers.back();
}

// Alpha has no rows yet; the bars keep the names of their codes.
TEST(ProgramErrors, PartsOfAReportKeepTheNamesOfBars) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  const RegisterComponent red[]{{Register::primary, kRed}, {Register::texture0, kRed}};
  const RegisterComponent green[]{{Register::primary, kGreen}, {Register::texture0, kGreen}};
  const auto study = valid(program_error_study({}, profile, products_by_channel(profile),
                                               {.components = {red[0], red[1], green[0], green[1]}}));
  const std::vector<StudyRow> rows = study->run(0, {}).value();
  const auto report = study->report(rows, 1);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->answers[0], "Only 1 of 3 units were measured.");
  const auto histogram = std::find_if(report->plots.begin(), report->plots.end(),
                                      [](const Plot& plot) { return plot.file == "histogram"; });
  ASSERT_NE(histogram, report->plots.end());
  EXPECT_EQ(histogram->x_names, (std::vector<std::string>{"-1", "0", "1"}));
  ASSERT_EQ(histogram->series.size(), 4U);
  EXPECT_EQ(histogram->series[0].points.size(), 3U);
  EXPECT_TRUE(histogram->series[3].points.empty());
}

// Answers need no second evaluation of the fragments, and a drawing ends when it is cancelled.
TEST(ProgramErrors, DrawingsComeApartAndCanBeCancelled) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  const auto study =
      valid(program_error_study({}, profile, comparison(profile),
                                {.components = {{Register::primary, kRed}, {Register::texture0, kRed}}, .codes = {}}));
  const std::vector<StudyRow> rows = all_rows(*study);
  auto report = study->report(rows, 1);
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->heat_maps.empty() && report->files.empty());
  std::vector<double> shares;
  const auto keep = [&](double done) {
    shares.push_back(done);
    return true;
  };
  ASSERT_TRUE(study->draw(rows, keep, *report));
  EXPECT_EQ(report->heat_maps.size(), 1U);
  ASSERT_GT(shares.size(), 4U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  int calls = 0;
  const Status stopped = study->draw(
      rows, [&](double) { return ++calls < 2; }, *report);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
  EXPECT_EQ(calls, 2);
}

// A pixel over three inputs has the largest error over all values of the third.
TEST(ProgramErrors, MapsOfThreeInputsShowTheLargestError) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  HardwareProfile profile = profiles::geforce2;
  profile.one.value = 31;
  profile.lowest.value = profile.lowest_output.value = -31;
  profile.half.value = 16;
  profile.expand_offset.value = 31;
  const Program program = comparison(profile);
  const auto study = valid(program_error_study(
      {}, profile, program,
      {.components = {{Register::primary, kRed}, {Register::texture0, kRed}, {Register::texture0, kGreen}},
       .codes = {}}));
  const StudyReport report = drawn_report(*study, all_rows(*study));
  ASSERT_EQ(report.heat_maps.size(), 1U);
  const HeatMap& map = report.heat_maps[0];
  EXPECT_EQ(map.title, "Largest error of alpha over all values of tex0.g");
  ASSERT_EQ(map.values.size(), 32U * 32U);
  double overall = 0.0;
  for (int red = 0; red <= 31; ++red) {
    for (int other = 0; other <= 31; ++other) {
      double most = 0.0;
      for (int third = 0; third <= 31; ++third) {
        RegisterFile registers = default_registers(profile);
        registers[Register::primary][kRed] = static_cast<s9>(red);
        registers[Register::texture0] = {static_cast<s9>(other), static_cast<s9>(third), 0, 0};
        const double error =
            evaluate(program, registers)[kAlpha] - 31.0 * evaluate_real(program, registers).color[kAlpha];
        if (std::fabs(error) > std::fabs(most) + 1e-7) most = error;
      }
      ASSERT_NEAR(map.values[static_cast<std::size_t>((31 - other) * 32 + red)], most, 1e-5) << red << ' ' << other;
      overall = std::max(overall, std::fabs(most));
    }
  }
  EXPECT_GT(overall, 0.0);
}

// More fragments than a unit holds: the report is on all of them.
TEST(ProgramErrors, UnitsAddUpInTheReport) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = comparison(profile);
  ProgramInputs inputs{.components = {{Register::primary, kRed}}, .codes = std::vector<s9>{}};
  constexpr int kFragments = (1 << 18) + 1000;
  for (int i = 0; i < kFragments; ++i) inputs.codes->push_back(static_cast<s9>(i < (1 << 18) ? i % 64 : 65));
  double sizes = 0.0, most = 0.0;
  const auto size_of = [&](int code) {
    RegisterFile registers;
    registers[Register::primary][kRed] = static_cast<s9>(code);
    return std::fabs(to_real(profile, evaluate(program, registers)[kAlpha]) -
                     evaluate_real(program, registers).color[kAlpha]);
  };
  for (int code = 0; code < 64; ++code) {
    sizes += size_of(code) * (1 << 12);
    most = std::max(most, size_of(code));
  }
  sizes += size_of(65) * 1000;
  most = std::max(most, size_of(65));

  const auto study = valid(program_error_study({}, profile, program, inputs));
  ASSERT_EQ(study->units(), 2U);
  const std::vector<StudyRow> rows = all_rows(*study);
  EXPECT_EQ(rows.size(), 2U * (4U + 4U * 3U + 4U * 17U));
  const StudyReport report = drawn_report(*study, rows);
  const std::vector<StudyValue>& alpha = report.tables.at(0).rows.at(3);
  EXPECT_EQ(std::get<std::uint64_t>(alpha.at(1)), static_cast<std::uint64_t>(kFragments));
  EXPECT_NEAR(std::get<double>(alpha.at(4)), most * 255.0, 1e-8);
  EXPECT_NEAR(std::get<double>(alpha.at(5)), sizes * 255.0 / kFragments, 1e-8);
  EXPECT_TRUE(report.heat_maps.empty());
}

// A constant among the components stands in for the program's own.
TEST(ProgramErrors, ConstantsVary) {
  const HardwareProfile& profile = profiles::geforce2;
  CombinerState state = rc10("const0 = (0, 0, 0, 0);\n{ rgb { spare0 = col0 * const0; } }\nout.rgb = spare0;\n");
  state.constant0 = {200.0F / 255.0F, 0.0F, 0.0F, 0.0F};
  const auto red = [](const Program& program, ProgramInputs inputs) {
    const auto study = valid(program_error_study({}, profiles::geforce2, program, std::move(inputs)));
    return row_of(all_rows(*study), "rows", "r");
  };
  const StudyRow own =
      red(compiled(state, profile), {.components = {{Register::primary, kRed}}, .codes = std::vector<s9>{77, 130}});
  state.constant0 = {};
  const StudyRow replaced =
      red(compiled(state, profile), {.components = {{Register::primary, kRed}, {Register::constant0, kRed}},
                                     .codes = std::vector<s9>{77, 200, 130, 200}});
  EXPECT_GT(own.number("max_error_codes"), 0.0);
  EXPECT_EQ(own.number("max_error_codes"), replaced.number("max_error_codes"));
  EXPECT_EQ(own.number("mean_bias_codes"), replaced.number("mean_bias_codes"));
  EXPECT_EQ(own.number("worst_exact_codes"), replaced.number("worst_exact_codes"));
  EXPECT_EQ(replaced.text("worst").find("primary.r 77, const0.r 200") != std::string::npos,
            own.text("worst") == "primary.r 77");
}

// Every column of a report's table that holds real numbers names their unit: codes or percent.
void expect_units(const Study& study) {
  const auto report = study.report(all_rows(study), study.units());
  ASSERT_TRUE(report.ok());
  int reals = 0;
  for (const std::vector<ReportTable>* tables : {&report->tables, &report->summary}) {
    for (const ReportTable& table : *tables) {
      for (const auto& row : table.rows) {
        ASSERT_EQ(row.size(), table.columns.size()) << table.title;
        for (std::size_t i = 0; i < row.size(); ++i) {
          if (!std::holds_alternative<double>(row[i])) continue;
          ++reals;
          const std::string& head = table.columns[i];
          EXPECT_TRUE(head.ends_with(", codes") || head.find('%') != std::string::npos) << table.title << ": " << head;
        }
      }
    }
  }
  EXPECT_GT(reals, 5);
}

TEST(ProgramErrors, ColumnsOfTablesNameTheirUnit) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const HardwareProfile small = profiles::geforce256_8bit;
  expect_units(*valid(
      program_error_study({}, small, comparison(small), {.components = {{Register::primary, kRed}}, .codes = {}})));
  expect_units(*valid(datapath_study({}, std::vector{small, profiles::geforce2})));
}

TEST(ProgramErrors, RefusesWhatItCannotRunOver) {
  const HardwareProfile& profile = profiles::geforce2;
  const Program program = comparison(profile);
  const auto refusal = [&](const HardwareProfile& p, ProgramInputs inputs) {
    const auto study = program_error_study({}, p, program, std::move(inputs));
    return study ? std::string() : study.error().text();
  };
  ProgramInputs many{.components = {{Register::fog, kRed}}};
  for (int c = 0; c < 3; ++c) many.components.push_back({Register::primary, c});
  many.components.push_back({Register::texture0, kGreen});
  EXPECT_NE(refusal(profile, many)
                .find("more than 67108864 combinations of values, the maximum, and alpha depends on "
                      "primary.r, primary.g, primary.b, tex0.g together; "),
            std::string::npos)
      << refusal(profile, many);
  EXPECT_NE(refusal(profile, {}).find("no register component"), std::string::npos);
  many.codes = std::vector<s9>{};
  EXPECT_NE(refusal(profile, many).find("no fragment"), std::string::npos);
  EXPECT_NE(refusal(profiles::ideal, {.components = {{Register::fog, kRed}}, .codes = {}}).find("ideal"),
            std::string::npos);
  const auto study =
      valid(program_error_study({}, profile, program, {.components = {{Register::fog, kRed}}, .codes = {}}));
  const auto stopped = study->run(0, [] { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

}  // namespace
