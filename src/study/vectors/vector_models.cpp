// Runs wrong models of the combiners.
#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/portion_walk.h"
#include "src/study/vectors/mistaken_codes.h"
#include "src/study/vectors/vector_mistakes.h"

namespace ninebit::vectors {
namespace {

// A general combiner with its mistakes of order.
template <class T>
class MistakenStage {
 public:
  MistakenStage(const MistakenNumbers<T>& numbers, const ProgramStage& stage, NumberFile<T>& registers)
      : n_(numbers), stage_(stage), registers_(registers), domain_(numbers, stage, registers) {}

  void run() {
    compute<PortionName::rgb>(stage_.rgb);
    const bool in_turn = is_live(stage_.rgb.out) && is_live(stage_.alpha.out) && n_.has(BrokenRule::portions_in_turn);
    if (in_turn) write<PortionName::rgb>(domain_, stage_.rgb.out);
    compute<PortionName::alpha>(stage_.alpha);
    if (!in_turn) write<PortionName::rgb>(domain_, stage_.rgb.out);
    write<PortionName::alpha>(domain_, stage_.alpha.out);
  }

 private:
  using Domain = MistakenGeneral<T>;

  template <PortionName kName>
  void write(Domain& domain, const PortionOutput& out) {
    detail::write_portion<kName>(domain, out, steps_);
  }
  template <PortionName kName>
  void compute(const Portion& portion) {
    const bool in_turn = portion.out.ab != Register::discard && n_.has(BrokenRule::products_in_turn);
    if (!in_turn) return compute_outputs<kName>(portion, domain_);
    Portion first = portion;
    first.out.cd = first.out.sum = Register::discard;
    first.out.cd_dot_product = false;
    detail::compute_portion<kName>(domain_, first, steps_);
    NumberFile<T> after = registers_;
    Domain late(n_, stage_, after);
    write<kName>(late, first.out);
    Domain domain = domain_;
    domain.read_second(portion, after);
    compute_outputs<kName>(portion, domain);
  }
  template <PortionName kName>
  void compute_outputs(const Portion& portion, Domain& domain) {
    const PortionOutput& out = portion.out;
    const bool of_products = out.sum != Register::discard && (out.ab_dot_product || out.cd_dot_product) &&
                             n_.has(BrokenRule::thirds_of_products);
    detail::compute_portion<kName>(domain, portion, steps_);
    if (!of_products) return;
    Portion products = portion;
    products.out.ab = products.out.cd = Register::discard;
    products.out.ab_dot_product = products.out.cd_dot_product = false;
    Domain of_copy = domain;
    of_copy.read_second_of(products);
    detail::compute_portion<kName>(of_copy, products, steps_);
  }

  const MistakenNumbers<T>& n_;
  const ProgramStage& stage_;
  NumberFile<T>& registers_;
  Domain domain_;
  detail::StageSteps<Domain> steps_{};
};

bool is_in(const BrokenRules& rules, BrokenRule one) {
  return rules[static_cast<std::size_t>(one)];
}

}  // namespace

bool may_change(const Mistake& mistake, const AskedRules& asked) {
  return mistake.set || mistake.edit != nullptr || (mistake.in_general & asked.in_general).any() ||
         (mistake.in_final & asked.in_final).any();
}

Model::Model(const HardwareProfile& profile, const std::vector<Mistake>& mistakes, std::vector<std::size_t> made)
    : profile_(profile) {
  std::sort(made.begin(), made.end());
  for (const std::size_t m : made) {
    const Mistake& mistake = mistakes[m];
    if (mistake.set) mistake.set(profile_);
    in_general_ |= mistake.in_general;
    in_final_ |= mistake.in_final;
    if (mistake.edit != nullptr) edits_.push_back(mistake.edit);
  }
}

Program Model::program_of(const CombinerState& state) const {
  if (edits_.empty()) return normalize(state, profile_);
  CombinerState edited = state;
  for (void (*const edit)(CombinerState&) : edits_) edit(edited);
  return normalize(edited, profile_);
}

bool Model::keeps_registers() const {
  return is_in(in_general_, BrokenRule::registers_kept) || is_in(in_general_, BrokenRule::spare0_alpha_kept);
}

Bytes4 Model::run(const Program& program, const RegisterFile& input, Registers& kept, AskedRules* asked) const {
  // Exact fractions are computed in doubles, which is faster by far.
  if (asked == nullptr && breaks_nothing() && profile_.arithmetic.value != Arithmetic::exact) {
    return bytes_of(profile_, evaluate(program, input));
  }
  return profile_.arithmetic.value == Arithmetic::float32 ? run_in<float>(program, input, kept, asked)
                                                          : run_in<double>(program, input, kept, asked);
}

template <class T>
Bytes4 Model::run_in(const Program& program, const RegisterFile& input, Registers& kept, AskedRules* asked) const {
  const MistakenNumbers<T> general(program.datapath, in_general_), last(program.datapath, in_final_);
  NumberFile<T> registers;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) registers[r][c] = general.of_code(input.value[r][c]);
  }
  constexpr auto kSpare0 = static_cast<std::size_t>(Register::spare0),
                 kSpare1 = static_cast<std::size_t>(Register::spare1);
  if (general.has(BrokenRule::spare0_alpha_zero)) registers[kSpare0][kAlpha] = 0;
  if (general.has(BrokenRule::spare1_alpha_tex1)) {
    registers[kSpare1][kAlpha] = registers[static_cast<std::size_t>(Register::texture1)][kAlpha];
  }
  for (std::size_t c = 0; c < 4; ++c) {
    const bool keeps = general.has(c == kAlpha ? BrokenRule::spare0_alpha_kept : BrokenRule::registers_kept);
    if (keeps) registers[kSpare0][c] = static_cast<T>(kept[kSpare0][c]);
    if (general.has(BrokenRule::registers_kept)) registers[kSpare1][c] = static_cast<T>(kept[kSpare1][c]);
  }
  for (int i = 0; i < program.num_general_combiners; ++i) {
    MistakenStage<T>(general, program.general[static_cast<std::size_t>(i)], registers).run();
  }
  for (const std::size_t r : {kSpare0, kSpare1}) {
    for (std::size_t c = 0; c < 4; ++c) kept[r][c] = static_cast<double>(registers[r][c]);
  }
  detail::FinalSteps<MistakenFinal<T>> steps;
  MistakenFinal<T> domain(last, program, registers);
  detail::walk_final(domain, program, steps);
  Bytes4 bytes{};
  for (std::size_t c = 0; c < 4; ++c) {
    bytes[c] = last.byte_of(profile_, steps.color[c]);
  }
  if (bytes[kRed] != bytes[kBlue] && last.has(BrokenRule::red_blue_swapped)) std::swap(bytes[kRed], bytes[kBlue]);
  if (asked != nullptr) {
    asked->in_general |= general.asked();
    asked->in_final |= last.asked();
  }
  return bytes;
}

ModelColors::ModelColors(const VectorPack& pack, const Model& model, const std::vector<std::size_t>& programs)
    : pack_(pack), model_(model) {
  if (!model.keeps_registers()) return;
  shown_.resize(pack.programs.size());
  Model::Registers registers{};
  for (const std::size_t index : programs) {
    const VectorProgram& program = pack.programs[index];
    const Program compiled = model.program_of(program.state);
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      shown_[index].push_back(model.run(compiled, pack.inputs[program.first_input + i], registers));
    }
  }
}

std::vector<Bytes4> ModelColors::operator()(std::size_t index, AskedRules* asked) const {
  if (!shown_.empty()) {
    if (asked != nullptr) *asked = {BrokenRules().set(), BrokenRules().set()};
    return shown_[index];
  }
  const VectorProgram& program = pack_.programs[index];
  const Program compiled = model_.program_of(program.state);
  // An edit that changes nothing gives what the pack expects.
  const bool may_be_unchanged = asked == nullptr && model_.breaks_nothing();
  if (may_be_unchanged && compiled == normalize(program.state, pack_.profile)) return program.expected;
  Model::Registers kept{};
  std::vector<Bytes4> colors;
  for (std::size_t i = 0; i < pack_.fragments; ++i) {
    colors.push_back(model_.run(compiled, pack_.inputs[program.first_input + i], kept, asked));
  }
  return colors;
}

Bytes4 bytes_of(const HardwareProfile& profile, const Rgba9& color) {
  Bytes4 bytes{};
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = to_byte(profile, color[i]);
  return bytes;
}

}  // namespace ninebit::vectors
