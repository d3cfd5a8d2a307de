/* The register combiners of GeForce 2 and NV2A (Xbox), to the bit: see ninebit_combiner.h.

   Written by src/combiner/c99/generate.py of ninebit from the rules that ninebit's own C++ has. Do not edit. */
#include "ninebit_combiner.h"

static nbc_input make_nbc_input(nbc_register reg, nbc_mapping mapping, nbc_usage usage) {
  nbc_input input;
  input.reg = reg;
  input.mapping = mapping;
  input.usage = usage;
  return input;
}

/* ---- Registers --------------------------------------------------------------------------------------------------- */

/* Whether `r` is one of the four texture registers. */
static bool is_texture(nbc_register r) {
  return r >= NBC_TEXTURE0 && r <= NBC_TEXTURE3;
}

/* Returns the unit, 0 to 3, of a texture register. */
static int texture_unit_of(nbc_register r) {
  return (int)r - (int)NBC_TEXTURE0;
}

/* ---- Codes and bytes --------------------------------------------------------------------------------------------- */

/* Returns the code of a byte (texel, vertex colour, constant) in a register: 255 becomes 1.0 (rule 1). */
static int16_t from_byte(const nbc_profile *profile, uint8_t byte) {
  return (int16_t)(byte >> profile->byte_shift);
}

/* Returns the byte of a code in [0, one] in the frame buffer: 1.0 becomes 255, a negative code 0. Low bits that
   from_byte dropped are filled with the code's upper bits. */
static uint8_t to_byte(const nbc_profile *profile, int16_t code) {
  if (code <= 0) return 0;
  if (code >= profile->one) return 255;
  const int shift = profile->byte_shift;
  return (uint8_t)(shift == 0 ? code : (code << shift) | (code >> (8 - 2 * shift)));
}

/* Converts a GL colour component to a byte: clamps to [0, 1], rounds to nearest (OpenGL 1.3, 2.13.9). NaN becomes 0. */
static uint8_t byte_of_color(float component) {
  if (!(component > 0.0F)) return 0;
  if (component >= 1.0F) return 255;
  return (uint8_t)((double)component * 255.0 + 0.5);
}

/* ---- Profiles and defaults --------------------------------------------------------------------------------------- */

static const nbc_profile kProfiles[] = {
    {"geforce2", 255, -255, -255, 128, 255, 0, NBC_NARROW_TOWARD_ZERO, NBC_NARROW_AFTER_SCALE,
        NBC_NARROW_NEAREST_HALVES_UP, 2, 2, false, false, false, false},
    {"geforce2-early-truncation", 255, -255, -255, 128, 255, 0, NBC_NARROW_TOWARD_ZERO, NBC_NARROW_BEFORE_SCALE,
        NBC_NARROW_NEAREST_HALVES_UP, 2, 2, false, false, false, false},
    {"geforce256-8bit", 127, -127, -127, 64, 127, 1, NBC_NARROW_TOWARD_ZERO, NBC_NARROW_AFTER_SCALE,
        NBC_NARROW_NEAREST_HALVES_UP, 2, 2, false, false, false, false},
    {"nv2a", 255, -256, -255, 128, 255, 0, NBC_NARROW_NEAREST_HALVES_UP, NBC_NARROW_AFTER_SCALE,
        NBC_NARROW_NEAREST_HALVES_UP, 8, 4, true, true, true, true},
};

static nbc_input default_nbc_input(void) {
  nbc_input x;
  x.reg = NBC_ZERO;
  x.mapping = NBC_UNSIGNED_IDENTITY;
  x.usage = NBC_USE_RGB;
  return x;
}

static nbc_output default_nbc_output(void) {
  nbc_output x;
  x.ab = NBC_DISCARD;
  x.cd = NBC_DISCARD;
  x.sum = NBC_SPARE0;
  x.scale = NBC_SCALE_NONE;
  x.bias = NBC_BIAS_NONE;
  x.ab_dot_product = false;
  x.cd_dot_product = false;
  x.mux_sum = false;
  x.ab_blue_to_alpha = false;
  x.cd_blue_to_alpha = false;
  return x;
}

static nbc_portion default_nbc_portion(void) {
  nbc_portion x;
  x.a = default_nbc_input();
  x.b = default_nbc_input();
  x.c = default_nbc_input();
  x.d = default_nbc_input();
  x.out = default_nbc_output();
  return x;
}

/* The default portion of either name: spare0 = primary * 1 + 0. */
static nbc_portion default_portion(nbc_portion_name name) {
  const nbc_usage usage = name == NBC_PORTION_RGB ? NBC_USE_RGB : NBC_USE_ALPHA;
  nbc_portion portion = default_nbc_portion();
  portion.a = make_nbc_input(NBC_PRIMARY, NBC_UNSIGNED_IDENTITY, usage);
  portion.b = make_nbc_input(NBC_ZERO, NBC_UNSIGNED_INVERT, usage);
  portion.c = make_nbc_input(NBC_ZERO, NBC_UNSIGNED_IDENTITY, usage);
  portion.d = make_nbc_input(NBC_ZERO, NBC_UNSIGNED_IDENTITY, usage);
  return portion;
}

static nbc_general default_nbc_general(void) {
  nbc_general x;
  int i;
  x.rgb = default_portion(NBC_PORTION_RGB);
  x.alpha = default_portion(NBC_PORTION_ALPHA);
  for (i = 0; i < 4; ++i) x.constant0[i] = 0;
  for (i = 0; i < 4; ++i) x.constant1[i] = 0;
  return x;
}

static nbc_final default_nbc_final(void) {
  nbc_final x;
  x.a = make_nbc_input(NBC_FOG, NBC_UNSIGNED_IDENTITY, NBC_USE_ALPHA);
  x.b = make_nbc_input(NBC_SPARE0_PLUS_SECONDARY, NBC_UNSIGNED_IDENTITY, NBC_USE_RGB);
  x.c = make_nbc_input(NBC_FOG, NBC_UNSIGNED_IDENTITY, NBC_USE_RGB);
  x.d = default_nbc_input();
  x.e = default_nbc_input();
  x.f = default_nbc_input();
  x.g = make_nbc_input(NBC_SPARE0, NBC_UNSIGNED_IDENTITY, NBC_USE_ALPHA);
  return x;
}

static nbc_state default_nbc_state(void) {
  nbc_state x;
  int i;
  x.num_general_combiners = 1;
  x.color_sum_clamp = true;
  x.color_sum_invert_spare0 = false;
  x.color_sum_invert_secondary = false;
  x.per_stage_constants = false;
  x.mux_by_lowest_bit = false;
  for (i = 0; i < 4; ++i) x.constant0[i] = 0;
  for (i = 0; i < 4; ++i) x.constant1[i] = 0;
  for (i = 0; i < NBC_MAX_GENERAL_COMBINERS; ++i) x.general[i] = default_nbc_general();
  x.final_combiner = default_nbc_final();
  return x;
}

static nbc_stage default_nbc_stage(void) {
  nbc_stage x;
  int i;
  x.rgb = default_nbc_portion();
  x.alpha = default_nbc_portion();
  for (i = 0; i < 4; ++i) x.constant0[i] = 0;
  for (i = 0; i < 4; ++i) x.constant1[i] = 0;
  x.mux_by_lowest_bit = false;
  return x;
}

static nbc_program default_nbc_program(void) {
  nbc_program x;
  int i;
  x.datapath = kProfiles[0];
  x.num_general_combiners = 1;
  x.color_sum_clamp = true;
  x.color_sum_invert_spare0 = false;
  x.color_sum_invert_secondary = false;
  for (i = 0; i < NBC_MAX_GENERAL_COMBINERS; ++i) x.general[i] = default_nbc_stage();
  x.final_combiner = default_nbc_final();
  for (i = 0; i < 4; ++i) x.constant0[i] = 0;
  for (i = 0; i < 4; ++i) x.constant1[i] = 0;
  return x;
}

/* ---- Validation -------------------------------------------------------------------------------------------------- */

typedef struct {
  nbc_fault at; /* the place of the faults that follow */
  nbc_fault *faults;
  int most, count;
} nbc_findings;

static void findings_at(nbc_findings *findings, int stage, int portion, int variable, int parameter) {
  findings->at.stage = stage;
  findings->at.portion = portion;
  findings->at.variable = variable;
  findings->at.parameter = parameter;
}

static void findings_at_parameter(nbc_findings *findings, nbc_parameter parameter) {
  findings_at(findings, -1, -1, -1, parameter);
}

static void findings_at_output(nbc_findings *findings, int stage, nbc_portion_name portion) {
  findings_at(findings, stage, portion, -1, -1);
}

static void findings_at_variable(nbc_findings *findings, int stage, nbc_portion_name portion, nbc_variable variable) {
  findings_at(findings, stage, portion, variable, -1);
}

static void findings_at_final(nbc_findings *findings, nbc_variable variable) {
  findings_at(findings, -1, -1, variable, -1);
}

/* The error of each fault and its sentence, in the order of nbc_fault_kind. */
static const struct {
  nbc_gl_error gl_error;
  const char *text;
} kFaultTexts[] = {
    {NBC_GL_INVALID_VALUE, "num_general_combiners is {number}; profile {profile} has 1 to {combiners}"},
    {NBC_GL_INVALID_ENUM, "profile {profile} has no per-stage constants (NV_register_combiners2)"},
    {NBC_GL_INVALID_ENUM, "profile {profile} has no mux by the lowest bit of spare0's alpha (NV2A)"},
    {NBC_GL_INVALID_ENUM, "profile {profile} has no 1 - x in the colour sum (NV2A)"},
    {NBC_GL_INVALID_ENUM, "profile {profile} has {combiners} general combiners"},
    {NBC_GL_INVALID_ENUM, "a general combiner has the variables A to D"},
    {NBC_GL_INVALID_ENUM, "{register} cannot be read by a general combiner"},
    {NBC_GL_INVALID_ENUM, "{register} is beyond the {units} texture units of profile {profile}"},
    {NBC_GL_INVALID_ENUM, "unknown input mapping"},
    {NBC_GL_INVALID_ENUM, "unknown component usage"},
    {NBC_GL_INVALID_OPERATION, "component usage blue is for alpha portions; an RGB portion takes rgb or alpha"},
    {NBC_GL_INVALID_OPERATION, "component usage rgb is for RGB portions; an alpha portion takes alpha or blue"},
    {NBC_GL_INVALID_OPERATION, "fog's alpha can be read by the final combiner alone"},
    {NBC_GL_INVALID_ENUM, "unknown scale"},
    {NBC_GL_INVALID_ENUM, "unknown bias"},
    {NBC_GL_INVALID_ENUM, "{register} cannot be written"},
    {NBC_GL_INVALID_OPERATION, "two outputs go to {register}; each needs its own register"},
    {NBC_GL_INVALID_VALUE, "an alpha portion has no dot product"},
    {NBC_GL_INVALID_VALUE, "an alpha portion has no blue"},
    {NBC_GL_INVALID_ENUM, "profile {profile} has no blue-to-alpha outputs (NV2A)"},
    {NBC_GL_INVALID_OPERATION, "a bias of minus one half goes with no scale or with scale_by_two, not with {scale}"},
    {NBC_GL_INVALID_ENUM, "{register} cannot be read"},
    {NBC_GL_INVALID_ENUM, "the final combiner takes unsigned_identity and unsigned_invert, not {mapping}"},
    {NBC_GL_INVALID_OPERATION, "{register} can be read by the variables A to D alone"},
    {NBC_GL_INVALID_OPERATION, "spare0_plus_secondary_color can be read by the variables B, C and D alone"},
    {NBC_GL_INVALID_OPERATION, "component usage rgb is not for variable G, which takes alpha or blue"},
    {NBC_GL_INVALID_OPERATION, "component usage blue is for variable G alone"},
    {NBC_GL_INVALID_OPERATION, "{register} has no alpha; its component usage is rgb"},
};

static void findings_add(nbc_findings *findings, nbc_fault_kind what, int about) {
  if (findings->count < findings->most) {
    nbc_fault *fault = &findings->faults[findings->count];
    *fault = findings->at;
    fault->gl_error = kFaultTexts[what].gl_error;
    fault->what = what;
    fault->about = about;
  }
  ++findings->count;
}

/* How many general combiners a state may have. A profile that somebody changed may say more than there is room for. */
static int most_combiners(const nbc_profile *profile) {
  return profile->general_combiners < NBC_MAX_GENERAL_COMBINERS ? profile->general_combiners :
      NBC_MAX_GENERAL_COMBINERS;
}

static void check_unit(nbc_findings *findings, nbc_register r, const nbc_profile *profile) {
  if (is_texture(r) && texture_unit_of(r) >= profile->texture_units) {
    findings_add(findings, NBC_FAULT_NO_SUCH_UNIT, (int)r);
  }
}

static void check_combiner(nbc_findings *findings, int stage, const nbc_profile *profile) {
  if (stage < 0 || stage >= most_combiners(profile)) findings_add(findings, NBC_FAULT_NO_SUCH_COMBINER, stage);
}

/* Variable A to D of a general combiner. A caller may have cast any number to the enumerations, and evaluation
   relies on their enumerators. */
static void check_input(nbc_findings *findings, int stage, nbc_portion_name portion, nbc_variable variable,
    const nbc_input *input, const nbc_profile *profile) {
  findings_at_variable(findings, stage, portion, variable);
  check_combiner(findings, stage, profile);
  if (variable > NBC_VARIABLE_D) findings_add(findings, NBC_FAULT_NO_SUCH_VARIABLE, 0);
  if (input->reg >= NBC_E_TIMES_F) findings_add(findings, NBC_FAULT_NOT_FOR_GENERAL, (int)input->reg);
  check_unit(findings, input->reg, profile);
  if (input->mapping > NBC_SIGNED_NEGATE) findings_add(findings, NBC_FAULT_UNKNOWN_MAPPING, 0);
  if (input->usage > NBC_USE_BLUE) findings_add(findings, NBC_FAULT_UNKNOWN_USAGE, 0);
  if (portion == NBC_PORTION_RGB && input->usage == NBC_USE_BLUE) findings_add(findings, NBC_FAULT_BLUE_IN_RGB, 0);
  if (portion == NBC_PORTION_ALPHA && input->usage == NBC_USE_RGB) findings_add(findings, NBC_FAULT_RGB_IN_ALPHA, 0);
  if (input->reg == NBC_FOG && input->usage == NBC_USE_ALPHA) findings_add(findings, NBC_FAULT_FOG_ALPHA, 0);
}

static bool is_writable(nbc_register r) {
  return r == NBC_DISCARD || r == NBC_PRIMARY || r == NBC_SECONDARY || r == NBC_SPARE0 ||
         r == NBC_SPARE1 || is_texture(r);
}

static void check_destination(nbc_findings *findings, nbc_register r, const nbc_profile *profile) {
  if (!is_writable(r)) findings_add(findings, NBC_FAULT_NOT_WRITABLE, (int)r);
  check_unit(findings, r, profile);
}

static void check_pair(nbc_findings *findings, nbc_register r, nbc_register other) {
  if (r == other && r != NBC_DISCARD) findings_add(findings, NBC_FAULT_SAME_DESTINATION, (int)r);
}

/* The outputs of a portion. */
static void check_output(nbc_findings *findings, int stage, nbc_portion_name portion, const nbc_output *output,
    const nbc_profile *profile) {
  findings_at_output(findings, stage, portion);
  check_combiner(findings, stage, profile);
  if (output->scale > NBC_SCALE_BY_ONE_HALF) findings_add(findings, NBC_FAULT_UNKNOWN_SCALE, 0);
  if (output->bias > NBC_BIAS_BY_NEGATIVE_ONE_HALF) findings_add(findings, NBC_FAULT_UNKNOWN_BIAS, 0);
  check_destination(findings, output->ab, profile);
  check_destination(findings, output->cd, profile);
  check_destination(findings, output->sum, profile);
  check_pair(findings, output->ab, output->cd);
  check_pair(findings, output->ab, output->sum);
  check_pair(findings, output->cd, output->sum);
  if (portion == NBC_PORTION_ALPHA && (output->ab_dot_product || output->cd_dot_product)) {
    findings_add(findings, NBC_FAULT_DOT_IN_ALPHA, 0);
  }
  if (output->ab_blue_to_alpha || output->cd_blue_to_alpha) {
    if (portion == NBC_PORTION_ALPHA) findings_add(findings, NBC_FAULT_BLUE_TO_ALPHA_IN_ALPHA, 0);
    if (!profile->blue_to_alpha) findings_add(findings, NBC_FAULT_NO_BLUE_TO_ALPHA, 0);
  }
  if (output->bias != NBC_BIAS_NONE && (output->scale == NBC_SCALE_BY_FOUR || output->scale == NBC_SCALE_BY_ONE_HALF)) {
    findings_add(findings, NBC_FAULT_BIASED_SCALE, (int)output->scale);
  }
}

/* Variable A to G of the final combiner. */
static void check_final_input(nbc_findings *findings, nbc_variable variable, const nbc_input *input,
    const nbc_profile *profile) {
  findings_at_final(findings, variable);
  const bool computed = input->reg == NBC_E_TIMES_F || input->reg == NBC_SPARE0_PLUS_SECONDARY;
  if (input->reg >= NBC_DISCARD) findings_add(findings, NBC_FAULT_NOT_READABLE, (int)input->reg);
  check_unit(findings, input->reg, profile);
  if (input->usage > NBC_USE_BLUE) findings_add(findings, NBC_FAULT_UNKNOWN_USAGE, 0);
  if (input->mapping != NBC_UNSIGNED_IDENTITY && input->mapping != NBC_UNSIGNED_INVERT) {
    findings_add(findings, NBC_FAULT_MAPPING_NOT_FINAL, (int)input->mapping);
  }
  if (computed && variable >= NBC_VARIABLE_E) findings_add(findings, NBC_FAULT_COMPUTED_IN_E_TO_G, (int)input->reg);
  if (input->reg == NBC_SPARE0_PLUS_SECONDARY && variable == NBC_VARIABLE_A) findings_add(findings, NBC_FAULT_SUM_IN_A,
      0);
  if (variable == NBC_VARIABLE_G && input->usage == NBC_USE_RGB) findings_add(findings, NBC_FAULT_RGB_IN_G, 0);
  if (variable != NBC_VARIABLE_G && input->usage == NBC_USE_BLUE) findings_add(findings, NBC_FAULT_BLUE_NOT_IN_G, 0);
  if (computed && input->usage != NBC_USE_RGB) {
    findings_add(findings, NBC_FAULT_COMPUTED_ALPHA, (int)input->reg);
  }
}

static void check_portion(nbc_findings *findings, int stage, nbc_portion_name name, const nbc_portion *portion,
    const nbc_profile *profile) {
  check_input(findings, stage, name, NBC_VARIABLE_A, &portion->a, profile);
  check_input(findings, stage, name, NBC_VARIABLE_B, &portion->b, profile);
  check_input(findings, stage, name, NBC_VARIABLE_C, &portion->c, profile);
  check_input(findings, stage, name, NBC_VARIABLE_D, &portion->d, profile);
  check_output(findings, stage, name, &portion->out, profile);
}

/* A whole state: the parameters, all general combiners that the chip has, the final combiner. */
static void check_state(nbc_findings *findings, const nbc_state *state, const nbc_profile *profile) {
  findings_at_parameter(findings, NBC_PARAMETER_NUM_GENERAL_COMBINERS);
  if (state->num_general_combiners < 1 || state->num_general_combiners > most_combiners(profile)) {
    findings_add(findings, NBC_FAULT_WRONG_COMBINER_COUNT, state->num_general_combiners);
  }
  findings_at_parameter(findings, NBC_PARAMETER_PER_STAGE_CONSTANTS);
  if (state->per_stage_constants && !profile->per_stage_constants) findings_add(findings, NBC_FAULT_NO_STAGE_CONSTANTS,
      0);
  findings_at_parameter(findings, NBC_PARAMETER_MUX_BY_LOWEST_BIT);
  if (state->mux_by_lowest_bit && !profile->mux_by_lowest_bit) findings_add(findings, NBC_FAULT_NO_MUX_BY_LOWEST_BIT,
      0);
  findings_at_parameter(findings, NBC_PARAMETER_COLOR_SUM_INVERTS);
  if ((state->color_sum_invert_spare0 || state->color_sum_invert_secondary) && !profile->color_sum_inverts) {
    findings_add(findings, NBC_FAULT_NO_COLOR_SUM_INVERTS, 0);
  }
  for (int i = 0; i < most_combiners(profile); ++i) {
    const nbc_general *stage = &state->general[i];
    check_portion(findings, i, NBC_PORTION_RGB, &stage->rgb, profile);
    check_portion(findings, i, NBC_PORTION_ALPHA, &stage->alpha, profile);
  }
  const nbc_final *f = &state->final_combiner;
  check_final_input(findings, NBC_VARIABLE_A, &f->a, profile);
  check_final_input(findings, NBC_VARIABLE_B, &f->b, profile);
  check_final_input(findings, NBC_VARIABLE_C, &f->c, profile);
  check_final_input(findings, NBC_VARIABLE_D, &f->d, profile);
  check_final_input(findings, NBC_VARIABLE_E, &f->e, profile);
  check_final_input(findings, NBC_VARIABLE_F, &f->f, profile);
  check_final_input(findings, NBC_VARIABLE_G, &f->g, profile);
}

/* ---- Normalization ----------------------------------------------------------------------------------------------- */

/* The arithmetic of a profile. */
static nbc_profile datapath_of(const nbc_profile *profile) {
  return *profile;
}

/* Whether a portion writes anything. */
static bool is_live(const nbc_output *out) {
  return out->ab != NBC_DISCARD || out->cd != NBC_DISCARD || out->sum != NBC_DISCARD;
}

static nbc_portion normalize_portion(nbc_portion p) {
  nbc_output *out = &p.out;
  const bool sum = out->sum != NBC_DISCARD;
  if (!sum) out->mux_sum = false;
  if (!sum && out->ab == NBC_DISCARD) {
    p.a = p.b = default_nbc_input();
    out->ab_dot_product = false;
  }
  if (!sum && out->cd == NBC_DISCARD) {
    p.c = p.d = default_nbc_input();
    out->cd_dot_product = false;
  }
  if (out->ab == NBC_DISCARD) out->ab_blue_to_alpha = false;
  if (out->cd == NBC_DISCARD) out->cd_blue_to_alpha = false;
  if (!is_live(out)) {
    out->scale = NBC_SCALE_NONE;
    out->bias = NBC_BIAS_NONE;
  }
  return p;
}

static bool writes(const nbc_output *out, nbc_register r) {
  return out->ab == r || out->cd == r || out->sum == r;
}

/* Clears the RGB portion's blue to alpha for the registers whose alpha the alpha portion writes. */
static void normalize_blue_to_alpha(nbc_output *rgb, const nbc_output *alpha) {
  if (writes(alpha, rgb->ab)) rgb->ab_blue_to_alpha = false;
  if (writes(alpha, rgb->cd)) rgb->cd_blue_to_alpha = false;
}

/* For a normalized stage. */
static bool has_mux(const nbc_stage *stage) {
  return stage->rgb.out.mux_sum || stage->alpha.out.mux_sum;
}

static bool reads(const nbc_portion *p, nbc_register r) {
  return p->a.reg == r || p->b.reg == r || p->c.reg == r || p->d.reg == r;
}

/* Ignores E and F: only E times F reads them. */
static bool reads_directly(const nbc_final *f, nbc_register r) {
  return f->a.reg == r || f->b.reg == r || f->c.reg == r || f->d.reg == r || f->g.reg == r;
}

static nbc_final normalize_final(nbc_final f) {
  if (!reads_directly(&f, NBC_E_TIMES_F)) f.e = f.f = default_nbc_input();
  return f;
}

static bool stage_reads(const nbc_stage *stage, nbc_register r) {
  return reads(&stage->rgb, r) || reads(&stage->alpha, r);
}

static bool final_reads(const nbc_final *f, nbc_register r) {
  return reads_directly(f, r) || f->e.reg == r || f->f.reg == r;
}

static void constant_codes(const nbc_profile *profile, const float color[4], int16_t codes[4]) {
  for (int i = 0; i < 4; ++i) codes[i] = from_byte(profile, byte_of_color(color[i]));
}

/* A portion that does nothing. */
static nbc_portion dead_portion(void) {
  nbc_portion p = default_nbc_portion();
  p.out.sum = NBC_DISCARD;
  return p;
}

/* A general combiner that runs. */
static nbc_stage normalize_stage(const nbc_state *state, const nbc_general *from, const nbc_profile *profile) {
  nbc_stage stage = default_nbc_stage();
  stage.rgb = normalize_portion(from->rgb);
  stage.alpha = normalize_portion(from->alpha);
  normalize_blue_to_alpha(&stage.rgb.out, &stage.alpha.out);
  stage.mux_by_lowest_bit = state->mux_by_lowest_bit && has_mux(&stage);
  const bool own = state->per_stage_constants;
  if (stage_reads(&stage, NBC_CONSTANT0)) {
    constant_codes(profile, own ? from->constant0 : state->constant0, stage.constant0);
  }
  if (stage_reads(&stage, NBC_CONSTANT1)) {
    constant_codes(profile, own ? from->constant1 : state->constant1, stage.constant1);
  }
  return stage;
}

static nbc_program normalize_combiners(const nbc_state *state, const nbc_profile *profile) {
  nbc_program program = default_nbc_program();
  program.datapath = datapath_of(profile);
  program.num_general_combiners = state->num_general_combiners;
  for (int i = 0; i < NBC_MAX_GENERAL_COMBINERS; ++i) {
    const int at = i;
    if (i < state->num_general_combiners) {
      program.general[at] = normalize_stage(state, &state->general[at], profile);
    } else {
      program.general[at].rgb = program.general[at].alpha = dead_portion();
    }
  }
  program.final_combiner = normalize_final(state->final_combiner);
  const nbc_final *f = &program.final_combiner;
  if (final_reads(f, NBC_CONSTANT0)) constant_codes(profile, state->constant0, program.constant0);
  if (final_reads(f, NBC_CONSTANT1)) constant_codes(profile, state->constant1, program.constant1);
  const bool sums = final_reads(f, NBC_SPARE0_PLUS_SECONDARY);
  program.color_sum_clamp = state->color_sum_clamp || !sums;
  program.color_sum_invert_spare0 = state->color_sum_invert_spare0 && sums;
  program.color_sum_invert_secondary = state->color_sum_invert_secondary && sums;
  return program;
}

/* ---- Primitives -------------------------------------------------------------------------------------------------- */

static int set(int v) {
  return v;
}

static int add(int a, int b) {
  return a + b;
}

static int sub(int a, int b) {
  return a - b;
}

static int mul(int a, int b) {
  return a * b;
}

static int min_of(int a, int b) {
  return a < b ? a : b;
}

static int max_of(int a, int b) {
  return a > b ? a : b;
}

static int abs_of(int a) {
  return a < 0 ? -a : a;
}

static int divide(int n, int d) {
  return n / d;
}

static int negate_where_negative(int sign, int x) {
  return sign < 0 ? -x : x;
}

static int select_where_at_least(int v, int limit, int yes, int no) {
  return v >= limit ? yes : no;
}

/* ---- Arithmetic -------------------------------------------------------------------------------------------------- */

/* Rule 2 and the mapping table of NV_register_combiners: maps a register code to a factor of a product, in [-one,
   one]. */
static int map_input(const nbc_profile *d, nbc_mapping mapping, int e) {
  const int positive = max_of(e, set(0));
  switch (mapping) {
    case NBC_UNSIGNED_IDENTITY: return positive;
    case NBC_UNSIGNED_INVERT: return sub(set(d->one), min_of(positive, set(d->one)));
    case NBC_EXPAND_NORMAL: return sub(add(positive, positive), set(d->expand_offset));
    case NBC_EXPAND_NEGATE: return sub(set(d->expand_offset), add(positive, positive));
    case NBC_HALF_BIAS_NORMAL: return sub(positive, set(d->half));
    case NBC_HALF_BIAS_NEGATE: return sub(set(d->half), positive);
    case NBC_SIGNED_IDENTITY: return e;
    case NBC_SIGNED_NEGATE: return sub(set(0), e);
  }
  return e;
}

/* Returns n / divisor as a whole number, not limited to the register range. |n / divisor| must not exceed `most`. */
static int narrow(nbc_narrowing narrowing, int n, int divisor, int most) {
  if (narrowing == NBC_NARROW_TOWARD_ZERO) return negate_where_negative(n, divide(abs_of(n), divisor));
  /* Halves up is a division rounded down. Adding `most` whole quotients first keeps the dividend positive. */
  return sub(divide(add(n, set(divisor * most + divisor / 2)), divisor), set(most));
}

static int clamp_to(int v, int low, int high) {
  return min_of(max_of(v, set(low)), set(high));
}

/* Rules 3 and 4: adds an output's bias to a wide value (units of 1 / one^2). */
static int add_bias(const nbc_profile *d, nbc_bias bias, int wide) {
  return bias == NBC_BIAS_BY_NEGATIVE_ONE_HALF ? sub(wide, set(d->half * d->one)) : wide;
}

/* The divisor that makes a code of a value from scale_output, which doubles its results. */
static int scaled_unit(const nbc_profile *d) {
  return d->narrowing_point == NBC_NARROW_BEFORE_SCALE ? 2 : 2 * d->one;
}

/* Rule 7: returns the biased value or, in profiles that narrow before the scale, the code that it narrows to. */
static int narrow_before_scale(const nbc_profile *d, int biased) {
  /* Two dot products of three full products each, and the bias: the quotient stays below eight. */
  return d->narrowing_point == NBC_NARROW_BEFORE_SCALE ? narrow(d->general_narrowing, biased, d->one, 8 * d->one)
                                                           : biased;
}

/* Rules 5 and 6: returns twice the result of narrow_before_scale times the scale. Doubled, because the scale of one
   half must give a whole number. */
static int scale_output(nbc_scale scale, int v) {
  const int twice_scale = scale == NBC_SCALE_BY_ONE_HALF ? 1 : scale == NBC_SCALE_NONE ? 2 : scale == NBC_SCALE_BY_TWO
      ? 4 : 8;
  return mul(v, set(twice_scale));
}

/* Rule 8: narrows a value from scale_output to a code, not limited to the register range. The code's magnitude must
   not exceed `most`. */
static int narrow_output(const nbc_profile *d, int scaled, int most) {
  return narrow(d->general_narrowing, scaled, scaled_unit(d), most);
}

/* Clamps a code to the range of outputs, [lowest_output, one]. */
static int clamp_output(const nbc_profile *d, int code) {
  return clamp_to(code, d->lowest_output, d->one);
}

/* Rules 3 to 8 and 22: returns the code that a general combiner writes for a wide value: (wide + bias) x scale,
   narrowed and clamped to [lowest_output, one]. */
static int combiner_output(const nbc_profile *d, nbc_scale scale, nbc_bias bias, int wide) {
  const int scaled = scale_output(scale, narrow_before_scale(d, add_bias(d, bias, wide)));
  /* The first clamp only keeps the quotient small. The last clamp would cut the same values. */
  const int most = d->one + 1, limit = scaled_unit(d) * most;
  return clamp_output(d, narrow_output(d, clamp_to(scaled, -limit, limit), most));
}

/* Rule 11: chooses between the wide values AB and CD. By threshold: CD if spare0's alpha is at least one half, else
   AB. By lowest bit: CD if max(0, spare0's alpha) is odd, else AB. */
static int mux(const nbc_profile *d, bool by_lowest_bit, int spare0_alpha, int ab, int cd) {
  if (!by_lowest_bit) return select_where_at_least(spare0_alpha, set(d->half), cd, ab);
  const int positive = max_of(spare0_alpha, set(0));
  return select_where_at_least(sub(positive, mul(divide(positive, 2), set(2))), set(1), cd, ab);
}

/* Rule 13: returns a register's part of the colour sum: its code or, if `inverted`, one - max(0, code). */
static int color_sum_part(const nbc_profile *d, bool inverted, int v) {
  return inverted ? map_input(d, NBC_UNSIGNED_INVERT, v) : v;
}

/* Rule 13: returns max(0, spare0) + max(0, secondary), clamped to `one` if `clamp`; up to 2 one without the clamp. */
static int color_sum(const nbc_profile *d, bool clamp, int spare0, int secondary) {
  const int sum = add(max_of(spare0, set(0)), max_of(secondary, set(0)));
  return clamp ? min_of(sum, set(d->one)) : sum;
}

/* Rule 10: returns E*F, a code, for two mapped inputs in [0, one]. */
static int e_times_f(const nbc_profile *d, int e, int f) {
  return narrow(d->final_narrowing, mul(e, f), d->one, d->one);
}

/* Returns (1 - A)*C, a wide value. */
static int one_minus_a_times_c(const nbc_profile *d, int a, int c) {
  return mul(sub(set(d->one), a), c);
}

/* Rule 9: narrows A*B + (1 - A)*C to a code in [0, 2 one]. */
static int narrow_mix(const nbc_profile *d, int mix) {
  return narrow(d->final_narrowing, mix, d->one, 2 * d->one);
}

/* Rule 14: clamps a code to [0, one]. */
static int clamp_final(const nbc_profile *d, int v) {
  return clamp_to(v, 0, d->one);
}

/* Rules 9 and 14: narrows A*B + (1 - A)*C, adds D, clamps to [0, one]. A is in [0, one], the others are in [0, 2
   one]. */
static int final_rgb(const nbc_profile *d, int a, int b, int c, int added) {
  return clamp_final(d, add(narrow_mix(d, add(mul(a, b), one_minus_a_times_c(d, a, c))), added));
}

/* Rule 14: returns G clamped to [0, one], the alpha of the result. */
static int final_alpha(const nbc_profile *d, int g) {
  return clamp_final(d, g);
}

/* ---- Values of inputs -------------------------------------------------------------------------------------------- */

/* Returns one component of a register, of zero, or of a constant. */
static int fetch(int16_t registers[NBC_REGISTERS][4], nbc_register reg, int component, const int16_t constant0[4],
    const int16_t constant1[4]) {
  const int i = component;
  switch (reg) {
    case NBC_ZERO:
      return 0;
    case NBC_CONSTANT0:
      return constant0[i];
    case NBC_CONSTANT1:
      return constant1[i];
    default:
      return registers[reg][i];
  }
}

/* One of a portion's outputs in one of its channels. */
typedef struct {
  const nbc_output *out;
  int k; /* 0 AB, 1 CD, 2 the third: sum or mux */
  int component; /* that the channel writes */
} nbc_target;

static nbc_target make_nbc_target(const nbc_output *out, int k, int component) {
  nbc_target target;
  target.out = out;
  target.k = k;
  target.component = component;
  return target;
}

/* The register component that an input with this usage reads for channel `channel` of its portion: 0 to 2 of an RGB
   portion, 0 of an alpha portion. */
static int component_of(nbc_usage usage, int channel) {
  return usage == NBC_USE_RGB ? channel : usage == NBC_USE_ALPHA ? NBC_ALPHA : NBC_BLUE;
}

/* The components [first, end) that a portion writes: one for each of its channels. */
static int first_component(nbc_portion_name name) {
  return name == NBC_PORTION_RGB ? NBC_RED : NBC_ALPHA;
}

static int end_component(nbc_portion_name name) {
  return name == NBC_PORTION_RGB ? NBC_ALPHA : NBC_ALPHA + 1;
}

/* The register of output k of a portion. */
static nbc_register register_of(const nbc_output *out, int k) {
  return k == 0 ? out->ab : k == 1 ? out->cd : out->sum;
}

/* Whether output k also goes to the alpha of its register in this channel: its blue, with blue to alpha (rule 23). */
static bool copies_to_alpha(const nbc_output *out, int k, int component) {
  return component == NBC_BLUE && (k == 0 ? out->ab_blue_to_alpha : k == 1 && out->cd_blue_to_alpha);
}

/* ---- General combiners ------------------------------------------------------------------------------------------- */

/* The value domain of the reference: register codes. */
typedef struct {
  const nbc_profile *d_;
  const nbc_stage *stage_;
  int16_t (*registers_)[4];
} nbc_codes;

static int codes_input(const nbc_codes *self, const nbc_input *in, int component) {
  return map_input(self->d_, in->mapping, fetch(self->registers_, in->reg, component, self->stage_->constant0,
      self->stage_->constant1));
}

static int codes_product(const nbc_codes *self, int x, int y) {
  (void)self;
  return mul(x, y);
}

static int codes_sum(const nbc_codes *self, int x, int y) {
  (void)self;
  return add(x, y);
}

static int codes_mux(const nbc_codes *self, int ab, int cd) {
  return mux(self->d_, self->stage_->mux_by_lowest_bit, self->registers_[NBC_SPARE0][NBC_ALPHA], ab, cd);
}

static int codes_output(const nbc_codes *self, nbc_target target, int wide) {
  return combiner_output(self->d_, target.out->scale, target.out->bias, wide);
}

static void codes_write(nbc_codes *self, nbc_register to, int component, int code) {
  self->registers_[to][component] = (int16_t)code;
}

/* The values of one channel on the walk. Outputs that are discarded are not touched. */
typedef struct {
  int input[4]; /* A to D */
  int wide[3]; /* AB, CD and the third */
  int output[3]; /* of these */
} nbc_channel;

/* Computes product k, A*B or C*D, in all channels of its portion. */
static void compute_product(nbc_portion_name kName, nbc_codes *domain, int k, const nbc_input *x, const nbc_input *y,
    bool dot, nbc_channel steps[4]) {
  const int kFirst = first_component(kName), kEnd = end_component(kName);
  for (int c = kFirst; c < kEnd; ++c) {
    nbc_channel *at = &steps[c];
    at->input[2 * k] = codes_input(domain, x, component_of(x->usage, c - kFirst));
    at->input[2 * k + 1] = codes_input(domain, y, component_of(y->usage, c - kFirst));
    at->wide[k] = codes_product(domain, at->input[2 * k], at->input[2 * k + 1]);
  }
  if (!dot) return;
  int total = steps[kFirst].wide[k];
  for (int c = kFirst + 1; c < kEnd; ++c) total = codes_sum(domain, total, steps[c].wide[k]);
  for (int c = kFirst; c < kEnd; ++c) steps[c].wide[k] = total;
}

/* Computes a portion's outputs. A portion that writes nothing leaves `steps` unchanged. */
static void compute_portion(nbc_portion_name kName, nbc_codes *domain, const nbc_portion *portion,
    nbc_channel steps[4]) {
  const nbc_output *out = &portion->out;
  if (!is_live(out)) return;
  compute_product(kName, domain, 0, &portion->a, &portion->b, out->ab_dot_product, steps);
  compute_product(kName, domain, 1, &portion->c, &portion->d, out->cd_dot_product, steps);
  for (int c = first_component(kName); c < end_component(kName); ++c) {
    nbc_channel *at = &steps[c];
    if (out->ab != NBC_DISCARD) at->output[0] = codes_output(domain, make_nbc_target(out, 0, c), at->wide[0]);
    if (out->cd != NBC_DISCARD) at->output[1] = codes_output(domain, make_nbc_target(out, 1, c), at->wide[1]);
    if (out->sum == NBC_DISCARD) continue;
    at->wide[2] = out->mux_sum ? codes_mux(domain, at->wide[0], at->wide[1]) : codes_sum(domain, at->wide[0],
        at->wide[1]);
    at->output[2] = codes_output(domain, make_nbc_target(out, 2, c), at->wide[2]);
  }
}

/* Writes a portion's outputs. */
static void write_portion(nbc_portion_name kName, nbc_codes *domain, const nbc_output *out,
    const nbc_channel steps[4]) {
  for (int c = first_component(kName); c < end_component(kName); ++c) {
    const nbc_channel *at = &steps[c];
    for (int k = 0; k < 3; ++k) {
      const nbc_register to = register_of(out, k);
      if (to == NBC_DISCARD) continue;
      codes_write(domain, to, c, at->output[k]);
      if (copies_to_alpha(out, k, c)) codes_write(domain, to, NBC_ALPHA, at->output[k]);
    }
  }
}

/* Runs a general combiner. Both portions read all of their inputs before either writes (rule 12). */
static void walk_stage(nbc_codes *domain, const nbc_stage *stage, nbc_channel steps[4]) {
  compute_portion(NBC_PORTION_RGB, domain, &stage->rgb, steps);
  compute_portion(NBC_PORTION_ALPHA, domain, &stage->alpha, steps);
  write_portion(NBC_PORTION_RGB, domain, &stage->rgb.out, steps);
  write_portion(NBC_PORTION_ALPHA, domain, &stage->alpha.out, steps);
}

/* ---- Final combiner ---------------------------------------------------------------------------------------------- */

/* The value domain of the reference's final combiner: register codes. */
typedef struct {
  const nbc_profile *d_;
  const nbc_program *program_;
  int16_t (*registers_)[4];
} nbc_final_codes;

static int final_codes_map(const nbc_final_codes *self, nbc_mapping mapping, int e) {
  return map_input(self->d_, mapping, e);
}

static int final_codes_product(const nbc_final_codes *self, int e, int f) {
  return e_times_f(self->d_, e, f);
}

static int final_codes_sum_part(const nbc_final_codes *self, bool inverted, nbc_register r, int component) {
  return color_sum_part(self->d_, inverted, self->registers_[r][component]);
}

static int final_codes_sum(const nbc_final_codes *self, bool clamp, int spare0, int secondary) {
  return color_sum(self->d_, clamp, spare0, secondary);
}

static int final_codes_rgb(const nbc_final_codes *self, int unused, int a, int b, int c, int added) {
  (void)unused;
  return final_rgb(self->d_, a, b, c, added);
}

static int final_codes_alpha(const nbc_final_codes *self, int g) {
  return final_alpha(self->d_, g);
}

static int final_codes_input(const nbc_final_codes *self, const nbc_input *in, int component) {
  return final_codes_map(self, in->mapping, fetch(self->registers_, in->reg, component, self->program_->constant0,
      self->program_->constant1));
}

/* The values of the final combiner on the walk, by component. What is not computed is untouched. */
typedef struct {
  int input[6][4]; /* A to F; no alpha */
  int e_times_f[4], color_sum[4]; /* no alpha */
  int g;
  int color[4];
} nbc_final_steps;

/* Returns a variable's value in a channel: a register's component, E*F or the colour sum, mapped. */
static int final_input(nbc_final_codes *domain, const nbc_input *in, int channel, const nbc_final_steps *steps) {
  const int component = component_of(in->usage, channel);
  const int i = component;
  if (in->reg == NBC_E_TIMES_F) return final_codes_map(domain, in->mapping, steps->e_times_f[i]);
  if (in->reg == NBC_SPARE0_PLUS_SECONDARY) return final_codes_map(domain, in->mapping, steps->color_sum[i]);
  return final_codes_input(domain, in, component);
}

/* Computes the wanted components of the colour. */
static void walk_final(nbc_final_codes *domain, const nbc_program *program, nbc_final_steps *steps,
    const bool wanted[4]) {
  const nbc_final *f = &program->final_combiner;
  if (reads_directly(f, NBC_E_TIMES_F)) {
    for (int channel = 0; channel < 3; ++channel) {
      const int c = channel;
      steps->input[4][c] = final_codes_input(domain, &f->e, component_of(f->e.usage, channel));
      steps->input[5][c] = final_codes_input(domain, &f->f, component_of(f->f.usage, channel));
      steps->e_times_f[c] = final_codes_product(domain, steps->input[4][c], steps->input[5][c]);
    }
  }
  if (reads_directly(f, NBC_SPARE0_PLUS_SECONDARY)) {
    for (int channel = 0; channel < 3; ++channel) {
      steps->color_sum[channel] = final_codes_sum(domain, program->color_sum_clamp, final_codes_sum_part(domain,
          program->color_sum_invert_spare0, NBC_SPARE0, channel), final_codes_sum_part(domain,
          program->color_sum_invert_secondary, NBC_SECONDARY, channel));
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    const int c = channel;
    if (!wanted[c]) continue;
    steps->input[0][c] = final_input(domain, &f->a, channel, steps);
    steps->input[1][c] = final_input(domain, &f->b, channel, steps);
    steps->input[2][c] = final_input(domain, &f->c, channel, steps);
    steps->input[3][c] = final_input(domain, &f->d, channel, steps);
    steps->color[c] = final_codes_rgb(domain, channel, steps->input[0][c], steps->input[1][c], steps->input[2][c],
        steps->input[3][c]);
  }
  if (!wanted[NBC_ALPHA]) return;
  steps->g = final_input(domain, &f->g, NBC_ALPHA, steps);
  steps->color[NBC_ALPHA] = final_codes_alpha(domain, steps->g);
}

/* ---- Register words ---------------------------------------------------------------------------------------------- */

enum {
  kUsageBit = 4,
  kMappingShift = 5,
  kCdShift = 0,
  kAbShift = 4,
  kSumShift = 8,
  kCdDotBit = 12,
  kAbDotBit = 13,
  kMuxBit = 14,
  kBiasBit = 15,
  kScaleShift = 16,
  kCdBlueToAlphaBit = 18,
  kAbBlueToAlphaBit = 19,
  kNv10MuxMsbBit = 27,
  kNv10CountShift = 28,
  kNv20CountShift = 0,
  kNv20MuxMsbBit = 8,
  kNv20Unique0Bit = 12,
  kNv20Unique1Bit = 16,
  kSumInvertSpare0Bit = 5,
  kSumInvertSecondaryBit = 6,
  kColorSumClampBit = 7
};

static const nbc_register kRegisters[16] = {NBC_ZERO, NBC_CONSTANT0, NBC_CONSTANT1, NBC_FOG, NBC_PRIMARY,
    NBC_SECONDARY, NBC_DISCARD, NBC_DISCARD, NBC_TEXTURE0, NBC_TEXTURE1, NBC_TEXTURE2, NBC_TEXTURE3, NBC_SPARE0,
    NBC_SPARE1, NBC_SPARE0_PLUS_SECONDARY, NBC_E_TIMES_F};

static uint32_t bits(uint32_t word, int low, int count) {
  return (word >> low) & ((1U << count) - 1U);
}

/* Reads usage and mapping of the input whose byte begins at bit `low`. `scalar`: of an alpha portion or of variable
   G. The final combiner's words have only one bit of the mapping. */
static void read_input(uint32_t word, int low, bool scalar, int mapping_bits, nbc_input *input) {
  input->usage = scalar ? NBC_USE_BLUE : NBC_USE_RGB;
  if (bits(word, low + kUsageBit, 1) != 0) input->usage = NBC_USE_ALPHA;
  input->mapping = (nbc_mapping)(bits(word, low + kMappingShift, mapping_bits));
}

/* Reads what an output word has besides registers. */
static void read_output(uint32_t word, bool rgb, bool has_blue_to_alpha, nbc_output *out) {
  out->scale = (nbc_scale)(bits(word, kScaleShift, 2));
  out->bias = (nbc_bias)(bits(word, kBiasBit, 1));
  out->mux_sum = bits(word, kMuxBit, 1) != 0;
  out->ab_dot_product = rgb && bits(word, kAbDotBit, 1) != 0;
  out->cd_dot_product = rgb && bits(word, kCdDotBit, 1) != 0;
  out->ab_blue_to_alpha = rgb && has_blue_to_alpha && bits(word, kAbBlueToAlphaBit, 1) != 0;
  out->cd_blue_to_alpha = rgb && has_blue_to_alpha && bits(word, kCdBlueToAlphaBit, 1) != 0;
}

/* Reads the flags of the final combiner's second word. */
static void read_final_flags(uint32_t word, nbc_state *state) {
  state->color_sum_invert_spare0 = bits(word, kSumInvertSpare0Bit, 1) != 0;
  state->color_sum_invert_secondary = bits(word, kSumInvertSecondaryBit, 1) != 0;
  state->color_sum_clamp = bits(word, kColorSumClampBit, 1) != 0;
}

/* The NV2A outputs spare0 where both words of the final combiner are 0. */
static void leave_out_final_combiner(nbc_final *f) {
  f->d = make_nbc_input(NBC_SPARE0, NBC_UNSIGNED_IDENTITY, NBC_USE_RGB);
  f->g = make_nbc_input(NBC_SPARE0, NBC_UNSIGNED_IDENTITY, NBC_USE_ALPHA);
}

/* Whether a portion has a mux. Without one in any stage that is used, the mux bit has no meaning. */
static bool output_has_mux(const nbc_output *out) {
  return out->mux_sum && out->sum != NBC_DISCARD;
}

/* The colour of a constant's word. */
static void color_of(uint32_t argb, float color[4]) {
  for (int i = 0; i < 4; ++i) {
    const int low = i == NBC_ALPHA ? 24 : 16 - 8 * i;
    color[i] = (float)(bits(argb, low, 8)) / 255.0F;
  }
}

/* ---- The interface ----------------------------------------------------------------------------------------------- */

static bool begins_with(const char *text, const char *word) {
  while (*word != '\0' && *text == *word) {
    ++text;
    ++word;
  }
  return *word == '\0';
}

const nbc_profile *nbc_find_profile(const char *name) {
  size_t i;
  for (i = 0; i < sizeof kProfiles / sizeof kProfiles[0]; ++i) {
    if (begins_with(name, kProfiles[i].name) && begins_with(kProfiles[i].name, name)) return &kProfiles[i];
  }
  return NULL;
}

void nbc_default_state(nbc_state *state) { *state = default_nbc_state(); }

int nbc_validate(const nbc_state *state, const nbc_profile *profile, nbc_fault faults[], int most) {
  nbc_findings findings = {{0, 0, 0, 0, 0, 0, 0}, NULL, 0, 0};
  findings.faults = faults;
  findings.most = most;
  check_state(&findings, state, profile);
  return findings.count;
}

/* A text that is written into `to`, which has `size` bytes. */
typedef struct {
  char *to;
  int size, length;
} nbc_text;

static void put_text(nbc_text *text, const char *word) {
  for (; *word != '\0'; ++word, ++text->length) {
    if (text->length + 1 < text->size) text->to[text->length] = *word;
  }
}

static void put_number(nbc_text *text, int number) {
  char digits[16];
  int at = 15;
  unsigned rest = number < 0 ? 0u - (unsigned)number : (unsigned)number;
  digits[at] = '\0';
  do {
    digits[--at] = (char)('0' + rest % 10);
    rest /= 10;
  } while (rest != 0);
  if (number < 0) digits[--at] = '-';
  put_text(text, digits + at);
}

static void put_name(nbc_text *text, const char *const names[], int count, int number) {
  put_text(text, number >= 0 && number < count ? names[number] : "unknown");
}

int nbc_fault_text(const nbc_fault *fault, const nbc_profile *profile, char to[], int size) {
  static const char *const registers[] = {"zero", "constant_color0", "constant_color1", "fog", "primary_color",
      "secondary_color", "spare0", "spare1", "texture0", "texture1", "texture2", "texture3", "e_times_f",
      "spare0_plus_secondary_color", "discard"};
  static const char *const mappings[] = {"unsigned_identity", "unsigned_invert", "expand_normal", "expand_negate",
      "half_bias_normal", "half_bias_negate", "signed_identity", "signed_negate"};
  static const char *const scales[] = {"none", "scale_by_two", "scale_by_four", "scale_by_one_half"};
  const char *at = kFaultTexts[fault->what].text;
  nbc_text text;
  text.to = to;
  text.size = size;
  text.length = 0;
  while (*at != '\0') {
    char one[2] = {0, 0};
    if (*at != '{') {
      one[0] = *at++;
      put_text(&text, one);
      continue;
    }
    if (begins_with(at, "{profile}")) put_text(&text, profile->name);
    if (begins_with(at, "{combiners}")) put_number(&text, most_combiners(profile));
    if (begins_with(at, "{units}")) put_number(&text, profile->texture_units);
    if (begins_with(at, "{number}")) put_number(&text, fault->about);
    if (begins_with(at, "{register}")) put_name(&text, registers, 15, fault->about);
    if (begins_with(at, "{mapping}")) put_name(&text, mappings, 8, fault->about);
    if (begins_with(at, "{scale}")) put_name(&text, scales, 4, fault->about);
    while (*at++ != '}') {
    }
  }
  if (size > 0) to[text.length < size ? text.length : size - 1] = '\0';
  return text.length;
}

bool nbc_compile(const nbc_state *state, const nbc_profile *profile, nbc_program *program) {
  if (nbc_validate(state, profile, NULL, 0) != 0) return false;
  *program = normalize_combiners(state, profile);
  return true;
}

void nbc_run_stage(const nbc_program *program, int stage, int16_t registers[NBC_REGISTERS][4]) {
  nbc_codes codes;
  nbc_channel steps[4];
  codes.d_ = &program->datapath;
  codes.stage_ = &program->general[stage];
  codes.registers_ = registers;
  walk_stage(&codes, &program->general[stage], steps);
}

void nbc_run_final(const nbc_program *program, int16_t registers[NBC_REGISTERS][4], int16_t color[4]) {
  static const bool whole[4] = {true, true, true, true};
  nbc_final_codes codes;
  nbc_final_steps steps;
  int i;
  codes.d_ = &program->datapath;
  codes.program_ = program;
  codes.registers_ = registers;
  walk_final(&codes, program, &steps, whole);
  for (i = 0; i < 4; ++i) color[i] = (int16_t)steps.color[i];
}

void nbc_evaluate(const nbc_program *program, int16_t registers[NBC_REGISTERS][4], int16_t color[4]) {
  int i;
  for (i = 0; i < program->num_general_combiners; ++i) nbc_run_stage(program, i, registers);
  nbc_run_final(program, registers, color);
}

int16_t nbc_code(const nbc_profile *profile, uint8_t byte) { return from_byte(profile, byte); }

uint8_t nbc_byte(const nbc_profile *profile, int16_t code) { return to_byte(profile, code); }

/* Whether a chip has the register of a code, which goes to `reg`. */
static bool read_register(uint32_t code, nbc_chip chip, bool is_final0, nbc_register *reg) {
  const nbc_register found = kRegisters[code];
  const bool computed = found == NBC_E_TIMES_F || found == NBC_SPARE0_PLUS_SECONDARY;
  if (found == NBC_DISCARD || (computed && !is_final0)) return false;
  if (is_texture(found) && texture_unit_of(found) >= (chip == NBC_NV10 ? 2 : 4)) return false;
  *reg = found;
  return true;
}

/* The variable whose byte begins at bit `low`. A register that the chip does not have is NBC_DISCARD. */
static bool read_variable(uint32_t word, int low, nbc_chip chip, bool is_final0, bool scalar, int mapping_bits,
                          nbc_input *input) {
  input->reg = NBC_DISCARD;
  read_input(word, low, scalar, mapping_bits, input);
  return read_register(bits(word, low, 4), chip, is_final0, &input->reg);
}

static bool read_portion(uint32_t in, uint32_t out, nbc_chip chip, bool rgb, nbc_portion *portion) {
  nbc_register *const to[3] = {&portion->out.ab, &portion->out.cd, &portion->out.sum};
  static const int shifts[3] = {kAbShift, kCdShift, kSumShift};
  bool is_right = read_variable(in, 24, chip, false, !rgb, 3, &portion->a);
  int k;
  is_right = read_variable(in, 16, chip, false, !rgb, 3, &portion->b) && is_right;
  is_right = read_variable(in, 8, chip, false, !rgb, 3, &portion->c) && is_right;
  is_right = read_variable(in, 0, chip, false, !rgb, 3, &portion->d) && is_right;
  read_output(out, rgb, chip == NBC_NV20, &portion->out);
  for (k = 0; k < 3; ++k) {
    const uint32_t code = bits(out, shifts[k], 4);
    *to[k] = code != 0 ? NBC_ZERO : NBC_DISCARD; /* zero cannot be written */
    if (code != 0) is_right = read_register(code, chip, false, to[k]) && is_right;
  }
  return is_right;
}

static bool read_final(const nbc_words *words, nbc_chip chip, nbc_final *f) {
  bool is_right = read_variable(words->final0, 24, chip, true, false, 1, &f->a);
  is_right = read_variable(words->final0, 16, chip, true, false, 1, &f->b) && is_right;
  is_right = read_variable(words->final0, 8, chip, true, false, 1, &f->c) && is_right;
  is_right = read_variable(words->final0, 0, chip, true, false, 1, &f->d) && is_right;
  is_right = read_variable(words->final1, 24, chip, false, false, 1, &f->e) && is_right;
  is_right = read_variable(words->final1, 16, chip, false, false, 1, &f->f) && is_right;
  is_right = read_variable(words->final1, 8, chip, false, true, 1, &f->g) && is_right;
  if (chip == NBC_NV20 && words->final0 == 0 && words->final1 == 0) leave_out_final_combiner(f);
  return is_right;
}

bool nbc_read_words(const nbc_words *words, nbc_chip chip, nbc_state *state) {
  const bool nv20 = chip == NBC_NV20;
  const uint32_t control = nv20 ? words->enable : words->out_rgb[1];
  const int stages = nv20 ? 8 : 2;
  const int count = (int)(nv20 ? bits(control, kNv20CountShift, 4) : bits(control, kNv10CountShift, 2));
  bool is_right = count >= 1 && count <= stages, muxes = false;
  int i;
  nbc_default_state(state);
  for (i = 0; i < stages; ++i) {
    nbc_general *const stage = &state->general[i];
    is_right = read_portion(words->in_rgb[i], words->out_rgb[i], chip, true, &stage->rgb) && is_right;
    is_right = read_portion(words->in_alpha[i], words->out_alpha[i], chip, false, &stage->alpha) && is_right;
    muxes = muxes || (i < count && (output_has_mux(&stage->rgb.out) || output_has_mux(&stage->alpha.out)));
    if (nv20) {
      color_of(words->stage_color0[bits(control, kNv20Unique0Bit, 1) != 0 ? i : 0], stage->constant0);
      color_of(words->stage_color1[bits(control, kNv20Unique1Bit, 1) != 0 ? i : 0], stage->constant1);
    }
  }
  is_right = read_final(words, chip, &state->final_combiner) && is_right;
  read_final_flags(words->final1, state);
  color_of(words->color[0], state->constant0);
  color_of(words->color[1], state->constant1);
  state->num_general_combiners = count;
  state->per_stage_constants = nv20;
  state->mux_by_lowest_bit = muxes && bits(control, nv20 ? kNv20MuxMsbBit : kNv10MuxMsbBit, 1) == 0;
  return is_right;
}
