/* The register combiners for C and for languages that can call C: opaque handles, plain structures, no exceptions.
 *
 *   ninebit_state *state = NULL;
 *   ninebit_program *program = NULL;
 *   char *error = NULL;
 *   if (ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text, strlen(text), &state, &error) != NINEBIT_OK ||
 *       ninebit_compile(state, &program, &error) != NINEBIT_OK) { puts(error); ninebit_free_text(error); }
 *
 * Link with ninebit_capi (ninebit::capi in CMake, ninebit-capi in pkg-config). C99.
 *
 * Results. A function that can fail returns a ninebit_result. New objects are returned through the last pointers, which
 * are set to NULL on failure. If `error` is not NULL, it receives a text with one line per fault for every result but
 * NINEBIT_OK; it is NULL on success and may be NULL when memory runs out. The caller owns every text that is returned
 * through a char **, and frees it with ninebit_free_text. Each kind of handle has its own free function, which accepts
 * NULL.
 *
 * Threads. Any number of threads may use a const handle at once; programs never change. A handle that is not const may
 * be used by one thread at a time. There is no global state.
 *
 * Structures. The caller sets struct_size to sizeof the structure. A later version may add members at the end and still
 * accepts the shorter structure of a program that was compiled earlier. A size less than that of the first version is
 * NINEBIT_WRONG_ARGUMENT. Enumerations are passed as int; an unknown number is NINEBIT_WRONG_ARGUMENT.
 */
#pragma once

#include <stddef.h> /* NOLINT(modernize-deprecated-headers): for C */
#include <stdint.h> /* NOLINT(modernize-deprecated-headers) */

#include "ninebit/numerics/visibility.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The result of a call. */
typedef enum ninebit_result {
  NINEBIT_OK = 0,
  NINEBIT_INVALID_INPUT = 1,  /* an invalid text, word or state; the error names fault and place */
  NINEBIT_WRONG_ARGUMENT = 2, /* a NULL pointer, an unknown number or a code out of range */
  NINEBIT_OUT_OF_MEMORY = 3,  /* nothing was created */
  NINEBIT_INTERNAL_ERROR = 4  /* a bug in this library */
} ninebit_result;

/* The text forms of a program; docs/languages.md describes them. */
typedef enum ninebit_form {
  NINEBIT_FORM_GL_CALLS = 0,        /* C text: glCombinerInputNV(GL_COMBINER0_NV, …); */
  NINEBIT_FORM_RC10 = 1,            /* !!RC1.0, with !!TS1.0 or without */
  NINEBIT_FORM_NV10_WORDS = 2,      /* RC_IN_RGB[0] = 0x… lines, GeForce 256 and GeForce 2 */
  NINEBIT_FORM_NV20_WORDS = 3,      /* GeForce3, NV2A */
  NINEBIT_FORM_NV10_WORDS_JSON = 4, /* {"RC_IN_RGB[0]": "0x…"} */
  NINEBIT_FORM_NV20_WORDS_JSON = 5,
  NINEBIT_FORM_JSON = 6 /* {"ninebit": "program", …} */
} ninebit_form;

/* The chip class of register words: GeForce 256 and GeForce 2, or GeForce3 and NV2A. */
typedef enum ninebit_chip { NINEBIT_CHIP_NV10 = 0, NINEBIT_CHIP_NV20 = 1 } ninebit_chip;

/* The rows of ninebit_registers and of the input planes. The rows of `zero` and of the
   constants are not read: the program defines them. */
typedef enum ninebit_register {
  NINEBIT_ZERO = 0,
  NINEBIT_CONSTANT0 = 1,
  NINEBIT_CONSTANT1 = 2,
  NINEBIT_FOG = 3,
  NINEBIT_PRIMARY = 4,
  NINEBIT_SECONDARY = 5,
  NINEBIT_SPARE0 = 6,
  NINEBIT_SPARE1 = 7,
  NINEBIT_TEXTURE0 = 8,
  NINEBIT_TEXTURE1 = 9,
  NINEBIT_TEXTURE2 = 10,
  NINEBIT_TEXTURE3 = 11
} ninebit_register;
/* The number of registers. */
#define NINEBIT_REGISTERS 12

typedef struct ninebit_state ninebit_state;     /* the combiner state of GL, and its hardware profile */
typedef struct ninebit_program ninebit_program; /* a compiled, valid state; never changes */
typedef struct ninebit_report ninebit_report;   /* the result of validation */

/* The version of this library, "0.1.0". Lives as long as the library. */
NINEBIT_PUBLIC const char* ninebit_version(void);

/* The name of the hardware profile with this index, from 0; NULL past the last. It lives as long as the library. */
NINEBIT_PUBLIC const char* ninebit_profile_name(size_t index);

/* Frees a text that a char ** received; NULL is allowed. */
NINEBIT_PUBLIC void ninebit_free_text(char* text);

/* --- States ----------------------------------------------------------------------------------------------------------
   `profile` is the name of a profile; NULL stands for "geforce2". */

/* GL's default state. */
NINEBIT_PUBLIC ninebit_result ninebit_state_create(const char* profile, ninebit_state** state, char** error);

/* Parses a text of `length` bytes. */
NINEBIT_PUBLIC ninebit_result ninebit_state_parse(const char* profile, int form, const char* text, size_t length,
                                                  ninebit_state** state, char** error);

/* A register word. */
typedef struct ninebit_word {
  const char* name; /* such as "RC_IN_RGB[0]" */
  uint32_t value;   /* all 32 bits */
} ninebit_word;
/* Decodes `count` register words of a chip. docs/languages.md lists the names; missing words have the value that
   encodes GL's default. NINEBIT_INVALID_INPUT: an unknown or repeated name, bits that the chip does not accept, a state
   that GL refuses. */
NINEBIT_PUBLIC ninebit_result ninebit_state_from_words(const char* profile, int chip, const ninebit_word* words,
                                                       size_t count, ninebit_state** state, char** error);

/* An independent copy. */
NINEBIT_PUBLIC ninebit_result ninebit_state_copy(const ninebit_state* from, ninebit_state** state, char** error);
/* Frees a state; programs that were compiled from it stay valid. */
NINEBIT_PUBLIC void ninebit_state_free(ninebit_state* state);

/* The state in one of the forms. NINEBIT_INVALID_INPUT: the form cannot express the state; the error says why. */
NINEBIT_PUBLIC ninebit_result ninebit_state_print(const ninebit_state* state, int form, char** text, char** error);

/* GL's calls with GL's numbers. Each returns the error that GL would raise, or 0 (GL_NO_ERROR); a call with an error
   changes nothing. A NULL state also gives GL_INVALID_OPERATION (0x0502), NULL params give GL_INVALID_VALUE (0x0501).
   ninebit_gl_enable accepts GL_PER_STAGE_CONSTANTS_NV (and GL_REGISTER_COMBINERS_NV, without effect). */
NINEBIT_PUBLIC unsigned ninebit_gl_combiner_parameteri(ninebit_state* state, unsigned pname, int param);
/* glCombinerParameterfvNV: four floats for a constant colour, one for the others. */
NINEBIT_PUBLIC unsigned ninebit_gl_combiner_parameterfv(ninebit_state* state, unsigned pname, const float* params);
/* glCombinerInputNV. */
NINEBIT_PUBLIC unsigned ninebit_gl_combiner_input(ninebit_state* state, unsigned stage, unsigned portion,
                                                  unsigned variable, unsigned input, unsigned mapping,
                                                  unsigned component_usage);
/* glCombinerOutputNV; for the flags any value but 0 is true. */
NINEBIT_PUBLIC unsigned ninebit_gl_combiner_output(ninebit_state* state, unsigned stage, unsigned portion,
                                                   unsigned ab_output, unsigned cd_output, unsigned sum_output,
                                                   unsigned scale, unsigned bias, int ab_dot_product,
                                                   int cd_dot_product, int mux_sum);
/* glFinalCombinerInputNV. */
NINEBIT_PUBLIC unsigned ninebit_gl_final_combiner_input(ninebit_state* state, unsigned variable, unsigned input,
                                                        unsigned mapping, unsigned component_usage);
/* glCombinerStageParameterfvNV: four floats. */
NINEBIT_PUBLIC unsigned ninebit_gl_combiner_stage_parameterfv(ninebit_state* state, unsigned stage, unsigned pname,
                                                              const float* params);
/* glEnable if `enabled` is not 0, otherwise glDisable. */
NINEBIT_PUBLIC unsigned ninebit_gl_enable(ninebit_state* state, unsigned capability, int enabled);

/* --- Validation --------------------------------------------------------------------------------------------------- */

/* One fault that GL would refuse, and its place. */
typedef struct ninebit_diagnostic {
  size_t struct_size;  /* set by the caller */
  int32_t stage;       /* general combiner from 0; -1: final combiner or global */
  int32_t portion;     /* 0 RGB, 1 alpha; -1: not about one portion */
  int32_t variable;    /* 0 to 6 for A to G; -1: an output, a parameter */
  uint32_t gl_error;   /* 0x0500, 0x0501, 0x0502 */
  const char* message; /* one sentence; lives as long as the report */
} ninebit_diagnostic;

/* Everything that GL would refuse in a state. */
NINEBIT_PUBLIC ninebit_result ninebit_validate(const ninebit_state* state, ninebit_report** report, char** error);
/* The number of diagnostics; 0: the state is valid. */
NINEBIT_PUBLIC size_t ninebit_report_count(const ninebit_report* report);
/* The diagnostic with this index, from 0; NINEBIT_WRONG_ARGUMENT past the last. */
NINEBIT_PUBLIC ninebit_result ninebit_report_get(const ninebit_report* report, size_t index,
                                                 ninebit_diagnostic* diagnostic);
/* Frees a report and its messages. */
NINEBIT_PUBLIC void ninebit_report_free(ninebit_report* report);

/* --- Programs ----------------------------------------------------------------------------------------------------- */

/* Compiles a state. NINEBIT_INVALID_INPUT: the state is not valid; the error has one line per reason. */
NINEBIT_PUBLIC ninebit_result ninebit_compile(const ninebit_state* state, ninebit_program** program, char** error);
/* Frees a program; no other thread may be using it. */
NINEBIT_PUBLIC void ninebit_program_free(ninebit_program* program);

/* Register codes are whole numbers from ninebit_lowest to ninebit_one, which stands for 1.0: -255 and 255 in most
   profiles. */
NINEBIT_PUBLIC int ninebit_one(const ninebit_program* program);
/* The lowest code that a register can hold before the first stage. */
NINEBIT_PUBLIC int ninebit_lowest(const ninebit_program* program);

/* The registers of one fragment: red, green, blue, alpha. */
typedef struct ninebit_registers {
  size_t struct_size;                 /* set by the caller */
  int16_t code[NINEBIT_REGISTERS][4]; /* by ninebit_register and component */
} ninebit_registers;

/* The combiner inputs of one fragment, as bytes red, green, blue, alpha. */
typedef struct ninebit_inputs {
  size_t struct_size;         /* set by the caller */
  uint8_t primary[4];         /* the primary colour */
  uint8_t secondary[4];       /* the secondary colour; its alpha is read only if the profile says so */
  uint8_t fog_color[3];       /* red, green, blue, whether or not fog is enabled */
  uint8_t fog_factor;         /* 255: no fog at this fragment */
  uint8_t fog_enabled;        /* 0 or 1 */
  uint8_t texture_enabled[4]; /* 0 or 1 */
  uint8_t texture[4][4];      /* texels of RGBA textures, filtered */
} ninebit_inputs;

/* The registers before the first general combiner, as the program's profile initializes them. */
NINEBIT_PUBLIC ninebit_result ninebit_initial_registers(const ninebit_program* program, const ninebit_inputs* inputs,
                                                        ninebit_registers* registers, char** error);

/* Evaluates the program for one fragment. `color` receives the result of the final combiner, codes from 0 to
   ninebit_one. `after`, if not NULL, receives the registers after the last general combiner. */
NINEBIT_PUBLIC ninebit_result ninebit_evaluate(const ninebit_program* program, const ninebit_registers* registers,
                                               int16_t color[4], ninebit_registers* after, char** error);

/* Reads the texture of a unit, 0 to 3, at s, t, r: the filtered texel's red, green, blue, alpha, signed ones in two's
   complement. `data` is the caller's. It must not throw. */
typedef void (*ninebit_read_texel)(void* data, int unit, const float place[3], uint8_t texel[4]);

/* What the texture-shader stages do to a fragment, beside their texels. */
typedef struct ninebit_fate {
  size_t struct_size;   /* set by the caller */
  int32_t culled;       /* 0 or 1 */
  int32_t depth_is_set; /* 1: `depth` replaces the fragment's, in [0, 1], or in the buffer's codes as the state says */
  float depth;          /* not rounded or clamped; 0 if it is not set */
} ninebit_fate;

/* Runs the texture-shader stages of a program for one fragment. `at` has s, t, r, q of unit 0, not divided by q, then
   those of units 1 to 3. The textures are of the kinds that the operations read, RGBA, or DSDT_MAG where an offset
   texture reads one. `registers` receives the textures' registers, and texture 0's alpha as spare 0's; the others stay.
   `fate` may be NULL. NINEBIT_INVALID_INPUT: the state has no texture shaders enabled. */
NINEBIT_PUBLIC ninebit_result ninebit_run_stages(const ninebit_program* program, const float at[16],
                                                 ninebit_read_texel read_texel, void* data,
                                                 ninebit_registers* registers, ninebit_fate* fate, char** error);

/* Many fragments: a plane holds one component of one register, or of the colour, for `count` fragments. */
typedef struct ninebit_planes {
  size_t struct_size;                         /* set by the caller */
  size_t count;                               /* fragments in every plane */
  const int16_t* input[NINEBIT_REGISTERS][4]; /* NULL: 0 for every fragment */
  int16_t* color[4];                          /* NULL: not computed; must not be an input plane */
} ninebit_planes;

/* The same bits as ninebit_evaluate, computed by SIMD. If a code is out of range, no plane is written. */
NINEBIT_PUBLIC ninebit_result ninebit_evaluate_planes(const ninebit_program* program, const ninebit_planes* planes,
                                                      char** error);

/* Every step of one fragment as one JSON object, with the keys of `ninebit trace --json`. */
NINEBIT_PUBLIC ninebit_result ninebit_trace_json(const ninebit_program* program, const ninebit_registers* registers,
                                                 char** json, char** error);

/* The program as a GLSL function; glsl.h describes it. `version` is 330 (OpenGL 3.3) or 300 (OpenGL ES 3.0), `function`
   its name, NULL for "ninebit_combine". */
NINEBIT_PUBLIC ninebit_result ninebit_emit_glsl(const ninebit_program* program, int version, const char* function,
                                                char** glsl, char** error);

#ifdef __cplusplus
}
#endif
