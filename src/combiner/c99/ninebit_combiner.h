/* The register combiners of GeForce 2 and NV2A (Xbox), to the bit, in C99. An emulator takes this file and
   ninebit_combiner.c: no library, no allocation, no variable outside of functions. Any number of threads may call
   everything here.

   Written by src/combiner/c99/generate.py of ninebit from the rules that ninebit's own C++ has. Do not edit.

     nbc_state state;
     nbc_program program;
     int16_t registers[NBC_REGISTERS][4] = {{0}}, color[4];
     if (!nbc_read_words(&words, NBC_NV20, &state) ||   or nbc_default_state(&state), which cannot fail
         !nbc_compile(&state, nbc_find_profile("nv2a"), &program)) {...}
     registers[NBC_TEXTURE0][NBC_RED] = 201;            codes: 255 is 1.0
     nbc_evaluate(&program, registers, color);

   A state is what OpenGL has (NV_register_combiners), and what the NV2A adds to it. A profile says what a chip has and
   how it computes. The programs' results are those of `ninebit eval`; rules N are those of docs/numerics.md. */
/* generate.py lays this out: */
/* clang-format off */
#ifndef NINEBIT_COMBINER_H
#define NINEBIT_COMBINER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { NBC_REGISTERS = 12, NBC_MAX_GENERAL_COMBINERS = 8 };
/* Indices of the components in every array of four. */
enum { NBC_RED, NBC_GREEN, NBC_BLUE, NBC_ALPHA };

/* The registers that hold a value in a stage come first; their count is the size of a register file. */
typedef uint8_t nbc_register;
enum {
  NBC_ZERO,
  NBC_CONSTANT0,
  NBC_CONSTANT1,
  NBC_FOG,
  NBC_PRIMARY,
  NBC_SECONDARY,
  NBC_SPARE0,
  NBC_SPARE1,
  NBC_TEXTURE0,
  NBC_TEXTURE1,
  NBC_TEXTURE2,
  NBC_TEXTURE3,
  NBC_E_TIMES_F, /* final combiner only */
  NBC_SPARE0_PLUS_SECONDARY, /* final combiner only */
  NBC_DISCARD /* output only */
};

/* NV_register_combiners, table NV_register_combiners.3; e is the register component. */
typedef uint8_t nbc_mapping;
enum {
  NBC_UNSIGNED_IDENTITY, /* max(0, e) */
  NBC_UNSIGNED_INVERT, /* 1 - min(max(0, e), 1) */
  NBC_EXPAND_NORMAL, /* 2 max(0, e) - 1 */
  NBC_EXPAND_NEGATE, /* 1 - 2 max(0, e) */
  NBC_HALF_BIAS_NORMAL, /* max(0, e) - 1/2 */
  NBC_HALF_BIAS_NEGATE, /* 1/2 - max(0, e) */
  NBC_SIGNED_IDENTITY, /* e */
  NBC_SIGNED_NEGATE /* -e */
};

/* Which components of a register an input reads: red, green and blue; alpha for all channels; blue, in alpha
   portions only. */
typedef uint8_t nbc_usage;
enum {
  NBC_USE_RGB,
  NBC_USE_ALPHA,
  NBC_USE_BLUE
};

/* The factor of a portion's outputs, applied after the bias. */
typedef uint8_t nbc_scale;
enum {
  NBC_SCALE_NONE,
  NBC_SCALE_BY_TWO,
  NBC_SCALE_BY_FOUR,
  NBC_SCALE_BY_ONE_HALF
};

/* The term added to a portion's outputs: nothing or -1/2. */
typedef uint8_t nbc_bias;
enum {
  NBC_BIAS_NONE,
  NBC_BIAS_BY_NEGATIVE_ONE_HALF
};

/* The two portions of a general combiner. */
typedef uint8_t nbc_portion_name;
enum {
  NBC_PORTION_RGB,
  NBC_PORTION_ALPHA
};

/* An input: A to D of a general combiner, A to G of the final combiner. */
typedef uint8_t nbc_variable;
enum {
  NBC_VARIABLE_A,
  NBC_VARIABLE_B,
  NBC_VARIABLE_C,
  NBC_VARIABLE_D,
  NBC_VARIABLE_E,
  NBC_VARIABLE_F,
  NBC_VARIABLE_G
};

/* How a wide value is narrowed to the bits that a register can hold. */
typedef uint8_t nbc_narrowing;
enum {
  NBC_NARROW_TOWARD_ZERO, /* the low bits of the magnitude are dropped */
  NBC_NARROW_NEAREST_HALVES_UP /* to the nearest code, a half upward */
};

/* The point in a general combiner at which the low bits are dropped. */
typedef uint8_t nbc_narrowing_point;
enum {
  NBC_NARROW_AFTER_SCALE, /* products, sum, bias and scale are computed wide and narrowed once */
  NBC_NARROW_BEFORE_SCALE /* the biased sum is narrowed to a whole code, then scaled */
};

/* What a chip has and how it computes. A value: copy one and change a field to try a "what if". Numbers must be in the
   ranges that stand beside them: nbc_validate does not look at the profile. */
typedef struct nbc_profile {
  const char *name;
  int one; /* the code of 1.0; 255 >> byte_shift */
  int lowest; /* the lowest code that a register can hold before the first stage; -one - 1 to -one */
  /* the lowest code that a general combiner writes; at least `lowest`; the higher of lowest and -one - 1 to -one */
  int lowest_output;
  int half; /* bias of one half, half-bias mapping, mux threshold; 0 to one */
  int expand_offset; /* the expanding mappings give 2v - this; one to one + 1 */
  int byte_shift; /* number of low bits of a byte (texel, colour, constant) that a register drops; 0 to 4 */
  nbc_narrowing general_narrowing; /* of a general combiner's outputs */
  nbc_narrowing_point narrowing_point; /* of a general combiner's outputs */
  nbc_narrowing final_narrowing; /* of A*B + (1 - A)*C and of E*F */
  int general_combiners; /* 1 to 8 */
  int texture_units; /* 1 to 4 */
  bool per_stage_constants; /* NV_register_combiners2 */
  bool blue_to_alpha; /* an RGB portion may write its blue to a register's alpha */
  bool mux_by_lowest_bit; /* the mux may test the lowest bit of spare0's alpha */
  bool color_sum_inverts; /* spare0 and the secondary colour may go into the colour sum as 1 - x */
} nbc_profile;
/* NBC_ARITHMETIC(X) is X(member) for each member of nbc_profile that the arithmetic reads, NBC_CHIP(X) the same for the
   others but the name. */
#define NBC_ARITHMETIC(X) \
  X(one) X(lowest) X(lowest_output) X(half) X(expand_offset) X(general_narrowing) X(narrowing_point) \
  X(final_narrowing)
#define NBC_CHIP(X) \
  X(byte_shift) X(general_combiners) X(texture_units) X(per_stage_constants) X(blue_to_alpha) X(mux_by_lowest_bit) \
  X(color_sum_inverts)

/* The source of one variable, as CombinerInputNV and FinalCombinerInputNV set it. */
typedef struct nbc_input {
  nbc_register reg; /* what is read */
  nbc_mapping mapping; /* applied before the multiplication */
  nbc_usage usage; /* which of its components */
} nbc_input;

/* The outputs of a portion, as CombinerOutputNV sets them. */
typedef struct nbc_output {
  nbc_register ab; /* the register that gets A*B */
  nbc_register cd; /* the register that gets C*D */
  nbc_register sum; /* the register that gets the third output: AB + CD or the mux */
  nbc_scale scale; /* of all three outputs */
  nbc_bias bias; /* of all three outputs, added before the scale */
  bool ab_dot_product; /* A*B is the sum over red, green and blue; RGB portions only */
  bool cd_dot_product; /* the same for C*D */
  bool mux_sum; /* the third output is mux(AB, CD) instead of AB + CD */
  /* NV2A, not in GL, RGB portions only: the alpha of AB's (CD's) register gets the blue that is written to it,
     unless the alpha portion writes that alpha (rule 23). */
  bool ab_blue_to_alpha;
  bool cd_blue_to_alpha;
} nbc_output;

/* A portion of a general combiner: two products and their outputs. */
typedef struct nbc_portion {
  nbc_input a; /* the factors of A*B and C*D */
  nbc_input b;
  nbc_input c;
  nbc_input d;
  nbc_output out; /* where the products and the third output go */
} nbc_portion;

/* One general combiner. Both portions read the registers as the previous stage left them. */
typedef struct nbc_general {
  nbc_portion rgb; /* writes red, green and blue */
  nbc_portion alpha; /* writes alpha */
  float constant0[4]; /* replaces the global constant 0 if per_stage_constants is set */
  float constant1[4]; /* the same for constant 1 */
} nbc_general;

/* RGB = A*B + (1 - A)*C + D, alpha = G. The defaults are colour sum and fog. */
typedef struct nbc_final {
  nbc_input a; /* the weight of the mix */
  nbc_input b; /* the result of the mix if A is 1 */
  nbc_input c; /* the result of the mix if A is 0 */
  nbc_input d; /* D is added to the mix; E and F are the factors of E*F */
  nbc_input e;
  nbc_input f;
  nbc_input g; /* alpha */
} nbc_final;

/* The whole state: the values that GL's Get calls would return. */
typedef struct nbc_state {
  int num_general_combiners; /* GL_NUM_GENERAL_COMBINERS_NV: 1 to the profile's number */
  bool color_sum_clamp; /* GL_COLOR_SUM_CLAMP_NV: spare0 + secondary is clamped to [0, 1] */
  bool color_sum_invert_spare0; /* NV2A, not in GL: spare0 goes into the colour sum as 1 - x */
  bool color_sum_invert_secondary; /* the same for the secondary colour */
  bool per_stage_constants; /* GL_PER_STAGE_CONSTANTS_NV, of NV_register_combiners2 */
  bool mux_by_lowest_bit; /* NV2A, not in GL: muxes test the lowest bit of spare0's alpha */
  float constant0[4]; /* GL_CONSTANT_COLOR0_NV */
  float constant1[4]; /* GL_CONSTANT_COLOR1_NV */
  nbc_general general[NBC_MAX_GENERAL_COMBINERS]; /* those past num_general_combiners are kept but do nothing */
  nbc_final final_combiner; /* computes the colour */
} nbc_state;

/* A general combiner of a program: its portions, and its constants as codes. */
typedef struct nbc_stage {
  nbc_portion rgb; /* normalized */
  nbc_portion alpha;
  int16_t constant0[4]; /* codes */
  int16_t constant1[4];
  bool mux_by_lowest_bit; /* whether muxes test the lowest bit of spare0's alpha instead of the threshold */
} nbc_stage;

/* A normalized state, ready to be evaluated; nbc_compile makes it. Two states that compute the same with the same
   portions give equal programs: inputs whose product is not used, constants that nothing reads, flags without effect
   and stages past the last are set to fixed values. */
typedef struct nbc_program {
  nbc_profile datapath; /* the arithmetic of the profile it was compiled for */
  int num_general_combiners; /* that run: 1 to NBC_MAX_GENERAL_COMBINERS */
  bool color_sum_clamp; /* true also if nothing reads the colour sum */
  bool color_sum_invert_spare0; /* whether 1 - x of spare0 goes into the colour sum */
  bool color_sum_invert_secondary; /* likewise of the secondary colour */
  nbc_stage general[NBC_MAX_GENERAL_COMBINERS]; /* those past the last do nothing */
  nbc_final final_combiner; /* normalized */
  int16_t constant0[4]; /* of the final combiner, codes */
  int16_t constant1[4];
} nbc_program;

/* The profile of that name: "geforce2", "geforce2-early-truncation", "geforce256-8bit", "nv2a". NULL: none. */
const nbc_profile *nbc_find_profile(const char *name);

/* OpenGL's default state. */
void nbc_default_state(nbc_state *state);

/* ---- Validation -------------------------------------------------------------------------------------------------- */

/* OpenGL's error codes, by GL's numbers. */
typedef uint16_t nbc_gl_error;
enum {
  NBC_GL_NO_ERROR = 0,
  NBC_GL_INVALID_ENUM = 0x0500,
  NBC_GL_INVALID_VALUE = 0x0501,
  NBC_GL_INVALID_OPERATION = 0x0502
};

/* The parameters of a state that are neither a portion's nor a variable's. */
typedef uint8_t nbc_parameter;
enum {
  NBC_PARAMETER_NUM_GENERAL_COMBINERS,
  NBC_PARAMETER_PER_STAGE_CONSTANTS,
  NBC_PARAMETER_MUX_BY_LOWEST_BIT,
  NBC_PARAMETER_COLOR_SUM_INVERTS
};

/* What is wrong; nbc_fault_text has a sentence for each. */
typedef uint8_t nbc_fault_kind;
enum {
  NBC_FAULT_WRONG_COMBINER_COUNT,
  NBC_FAULT_NO_STAGE_CONSTANTS,
  NBC_FAULT_NO_MUX_BY_LOWEST_BIT,
  NBC_FAULT_NO_COLOR_SUM_INVERTS,
  NBC_FAULT_NO_SUCH_COMBINER,
  NBC_FAULT_NO_SUCH_VARIABLE,
  NBC_FAULT_NOT_FOR_GENERAL,
  NBC_FAULT_NO_SUCH_UNIT,
  NBC_FAULT_UNKNOWN_MAPPING,
  NBC_FAULT_UNKNOWN_USAGE,
  NBC_FAULT_BLUE_IN_RGB,
  NBC_FAULT_RGB_IN_ALPHA,
  NBC_FAULT_FOG_ALPHA,
  NBC_FAULT_UNKNOWN_SCALE,
  NBC_FAULT_UNKNOWN_BIAS,
  NBC_FAULT_NOT_WRITABLE,
  NBC_FAULT_SAME_DESTINATION,
  NBC_FAULT_DOT_IN_ALPHA,
  NBC_FAULT_BLUE_TO_ALPHA_IN_ALPHA,
  NBC_FAULT_NO_BLUE_TO_ALPHA,
  NBC_FAULT_BIASED_SCALE,
  NBC_FAULT_NOT_READABLE,
  NBC_FAULT_MAPPING_NOT_FINAL,
  NBC_FAULT_COMPUTED_IN_E_TO_G,
  NBC_FAULT_SUM_IN_A,
  NBC_FAULT_RGB_IN_G,
  NBC_FAULT_BLUE_NOT_IN_G,
  NBC_FAULT_COMPUTED_ALPHA
};

/* One fault of a state and its place. */
typedef struct nbc_fault {
  int stage;             /* general combiner from 0; -1: final combiner, or a parameter */
  int portion;           /* an nbc_portion_name; -1: not about one portion */
  int variable;          /* an nbc_variable; -1: an output, a parameter */
  int parameter;         /* an nbc_parameter; -1: about a portion or the final combiner */
  nbc_gl_error gl_error; /* that GL's setter would have raised */
  nbc_fault_kind what;
  int about; /* the register, mapping, scale or number that is wrong */
} nbc_fault;

/* Finds all that is wrong with a state. Returns the number of faults; writes the first `most` of them. */
int nbc_validate(const nbc_state *state, const nbc_profile *profile, nbc_fault faults[], int most);

/* Writes what is wrong as a sentence, without the place, cut to `size` bytes with the 0 at its end. Returns its length.
   `profile` is that of nbc_validate. */
int nbc_fault_text(const nbc_fault *fault, const nbc_profile *profile, char text[], int size);

/* ---- Programs ---------------------------------------------------------------------------------------------------- */

/* Validates and normalizes. false: the state is not valid, and the program is unchanged. */
bool nbc_compile(const nbc_state *state, const nbc_profile *profile, nbc_program *program);

/* Runs general combiner `stage` over one fragment's registers, in place. Rows of `registers` are numbered by
   nbc_register; codes lie from the profile's `lowest` to `one`. Those of zero and of the constants are not read: the
   program defines them. Before the first stage, spare0's alpha is texture 0's, and the rest of spare0 and spare1 are 0.
 */
void nbc_run_stage(const nbc_program *program, int stage, int16_t registers[NBC_REGISTERS][4]);

/* Runs the final combiner over the registers that the last stage left. The colour has codes from 0 to `one`. */
void nbc_run_final(const nbc_program *program, int16_t registers[NBC_REGISTERS][4], int16_t color[4]);

/* Runs all stages, which change `registers`, and the final combiner. */
void nbc_evaluate(const nbc_program *program, int16_t registers[NBC_REGISTERS][4], int16_t color[4]);

/* The code of a byte (a texel, a vertex colour) in a register, and the byte of a colour's code. */
int16_t nbc_code(const nbc_profile *profile, uint8_t byte);
uint8_t nbc_byte(const nbc_profile *profile, int16_t code);

/* ---- Register words ---------------------------------------------------------------------------------------------- */

/* GeForce 256 and GeForce 2, or GeForce3 and NV2A. */
typedef enum nbc_chip { NBC_NV10, NBC_NV20 } nbc_chip;

/* The words of a chip's registers; docs/languages.md has their bits. NV10 has the first two of each row. */
typedef struct nbc_words {
  uint32_t in_rgb[8];        /* RC_IN_RGB: variables A to D of an RGB portion */
  uint32_t in_alpha[8];      /* RC_IN_ALPHA */
  uint32_t out_rgb[8];       /* RC_OUT_RGB; on NV10, [1] also has the number of stages and the mux bit */
  uint32_t out_alpha[8];     /* RC_OUT_ALPHA */
  uint32_t stage_color0[8];  /* RC_CONSTANT_COLOR0, NV20: 0xAARRGGBB */
  uint32_t stage_color1[8];  /* RC_CONSTANT_COLOR1, NV20 */
  uint32_t color[2];         /* RC_COLOR: of all combiners on NV10, of the final combiner on NV20 */
  uint32_t final0, final1;   /* RC_FINAL0, RC_FINAL1 */
  uint32_t enable;           /* RC_ENABLE, NV20: number of stages, mux bit, which stages have constants of their own */
} nbc_words;

/* Reads the state of a chip's words. false: a word has a register code or a number of stages that the chip does not
   have. Then nbc_compile with a profile of the chip refuses the state, too: it has what else the words say, and
   NBC_DISCARD as an input, NBC_ZERO as an output, or the number. */
bool nbc_read_words(const nbc_words *words, nbc_chip chip, nbc_state *state);

/* ---- Many fragments ------------------------------------------------------------------------------------------------
   These three are not in ninebit_combiner.c but in ninebit's library for C (ninebit_capi), which is C++. They compute
   the same bits by SIMD. */

typedef struct nbc_batch nbc_batch;

/* Makes a program of nbc_compile ready. NULL: memory ran out. */
nbc_batch *nbc_batch_create(const nbc_program *program);
/* Evaluates `count` fragments. A plane holds one component of a register or of the colour; NULL stands for 0, or for a
   colour's component that is not wanted. Colours must not overlap inputs. false: memory ran out, or a code is out of
   range; then nothing is written. */
bool nbc_batch_evaluate(const nbc_batch *batch, size_t count, const int16_t *const input[NBC_REGISTERS][4],
                        int16_t *const color[4]);
/* Frees it; NULL is allowed. */
void nbc_batch_free(nbc_batch *batch);

#ifdef __cplusplus
}
#endif

#endif
