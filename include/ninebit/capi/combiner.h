/* The register combiners for C, and for whatever can call C: opaque handles, plain structures, no exceptions.
 *
 *   ninebit_state *state = NULL;
 *   ninebit_program *program = NULL;
 *   char *error = NULL;
 *   if (ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text, strlen(text), &state, &error) != NINEBIT_OK ||
 *       ninebit_compile(state, &program, &error) != NINEBIT_OK) { puts(error); ninebit_free_text(error); }
 *
 * Link with ninebit_capi (ninebit::capi in CMake, ninebit-capi in pkg-config). C99.
 *
 * Results. A function that can fail returns a ninebit_result. What it makes goes through its last pointers, which are
 * set to NULL when it fails. `error`, where it is not NULL, receives a text of its own for every result but NINEBIT_OK,
 * one line a fault, or NULL; it belongs to the caller, as every text does that comes through a char **: give it to
 * ninebit_free_text. Handles are freed by the function of their kind; NULL is allowed there.
 *
 * Threads. A const handle may be used by any number of threads at once; programs never change. A handle that is not
 * const belongs to one thread at a time. Nothing is global.
 *
 * Structures. struct_size is sizeof the structure, set by the caller: a later version may add members at the end, and
 * then still takes the shorter structure of a program that was compiled before. A size that is less than that of the
 * first version is NINEBIT_WRONG_ARGUMENT. Enumerations are passed as int; an unknown number is NINEBIT_WRONG_ARGUMENT.
 */
#pragma once

#include <stddef.h> /* NOLINT(modernize-deprecated-headers): for C */
#include <stdint.h> /* NOLINT(modernize-deprecated-headers) */

#include "ninebit/numerics/visibility.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a call went. */
typedef enum ninebit_result {
  NINEBIT_OK = 0,
  NINEBIT_INVALID_INPUT = 1,  /* a text, words or a state that is wrong: the error says what and where */
  NINEBIT_WRONG_ARGUMENT = 2, /* a call that cannot be meant: a NULL, an unknown number, a code out of range */
  NINEBIT_OUT_OF_MEMORY = 3,  /* nothing was made */
  NINEBIT_INTERNAL_ERROR = 4  /* a fault of this library */
} ninebit_result;

/* The forms that a program has as text; docs/languages.md describes them. */
typedef enum ninebit_form {
  NINEBIT_FORM_GL_CALLS = 0,        /* C text: glCombinerInputNV(GL_COMBINER0_NV, …); */
  NINEBIT_FORM_RC10 = 1,            /* !!RC1.0 */
  NINEBIT_FORM_NV10_WORDS = 2,      /* RC_IN_RGB[0] = 0x… lines, GeForce 256 and GeForce 2 */
  NINEBIT_FORM_NV20_WORDS = 3,      /* GeForce3, NV2A */
  NINEBIT_FORM_NV10_WORDS_JSON = 4, /* {"RC_IN_RGB[0]": "0x…"} */
  NINEBIT_FORM_NV20_WORDS_JSON = 5,
  NINEBIT_FORM_JSON = 6 /* {"ninebit": "program", …} */
} ninebit_form;

/* Whose register words: GeForce 256 and GeForce 2, or GeForce3 and NV2A. */
typedef enum ninebit_chip { NINEBIT_CHIP_NV10 = 0, NINEBIT_CHIP_NV20 = 1 } ninebit_chip;

/* The rows of ninebit_registers and of the input planes. `zero` and the constants are the program's affair: what stands
   there is not read. */
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
/* How many they are. */
#define NINEBIT_REGISTERS 12

typedef struct ninebit_state ninebit_state;     /* the combiners as GL holds them, and the profile they are of */
typedef struct ninebit_program ninebit_program; /* a valid state made ready to run; never changes */
typedef struct ninebit_report ninebit_report;   /* what validation found */

/* The version of this library, "0.1.0". Lives as long as the library. */
NINEBIT_PUBLIC const char* ninebit_version(void);

/* The names of the hardware profiles that there are, from 0 on; NULL past the last. They live as long as the library.
 */
NINEBIT_PUBLIC const char* ninebit_profile_name(size_t index);

/* Frees a text that a char ** received; NULL is allowed. */
NINEBIT_PUBLIC void ninebit_free_text(char* text);

/* --- States ----------------------------------------------------------------------------------------------------------
   `profile` is a name of a profile; NULL stands for "geforce2". */

/* GL's default state. */
NINEBIT_PUBLIC ninebit_result ninebit_state_create(const char* profile, ninebit_state** state, char** error);

/* The state that a text of `length` bytes describes. */
NINEBIT_PUBLIC ninebit_result ninebit_state_parse(const char* profile, int form, const char* text, size_t length,
                                                  ninebit_state** state, char** error);

/* A word of the chip's registers. */
typedef struct ninebit_word {
  const char* name; /* such as "RC_IN_RGB[0]" */
  uint32_t value;   /* all 32 bits */
} ninebit_word;
/* The state that `count` registers of a chip hold. Names are those of docs/languages.md; words that are missing have
   the value that encodes GL's default. NINEBIT_INVALID_INPUT: a name that is unknown or repeated, bits without meaning,
   a state that GL refuses. */
NINEBIT_PUBLIC ninebit_result ninebit_state_from_words(const char* profile, int chip, const ninebit_word* words,
                                                       size_t count, ninebit_state** state, char** error);

/* A copy that is independent of the first. */
NINEBIT_PUBLIC ninebit_result ninebit_state_copy(const ninebit_state* from, ninebit_state** state, char** error);
/* Frees a state; programs that were compiled from it stay. */
NINEBIT_PUBLIC void ninebit_state_free(ninebit_state* state);

/* The state in one of the forms. NINEBIT_INVALID_INPUT: the form cannot express it; the error says what it lacks. */
NINEBIT_PUBLIC ninebit_result ninebit_state_print(const ninebit_state* state, int form, char** text, char** error);

/* GL's calls, with GL's numbers for everything. Each returns the error that GL would raise, 0 (GL_NO_ERROR) for none; a
   call with an error changes nothing. GL_INVALID_OPERATION (0x0502) also stands for a NULL state, GL_INVALID_VALUE
   (0x0501) for NULL params. ninebit_gl_enable takes GL_PER_STAGE_CONSTANTS_NV (and GL_REGISTER_COMBINERS_NV, without
   effect). */
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
/* glEnable where `enabled` is not 0, else glDisable. */
NINEBIT_PUBLIC unsigned ninebit_gl_enable(ninebit_state* state, unsigned capability, int enabled);

/* --- Validation --------------------------------------------------------------------------------------------------- */

/* One thing that GL would refuse, and where. */
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
/* How many diagnostics there are; 0: the state is valid. */
NINEBIT_PUBLIC size_t ninebit_report_count(const ninebit_report* report);
/* A diagnostic, by its number from 0; NINEBIT_WRONG_ARGUMENT past the last. */
NINEBIT_PUBLIC ninebit_result ninebit_report_get(const ninebit_report* report, size_t index,
                                                 ninebit_diagnostic* diagnostic);
/* Frees a report and its messages. */
NINEBIT_PUBLIC void ninebit_report_free(ninebit_report* report);

/* --- Programs ----------------------------------------------------------------------------------------------------- */

/* NINEBIT_INVALID_INPUT: the state is not valid; the error has a line for each reason. */
NINEBIT_PUBLIC ninebit_result ninebit_compile(const ninebit_state* state, ninebit_program** program, char** error);
/* Frees a program; no other thread may be using it. */
NINEBIT_PUBLIC void ninebit_program_free(ninebit_program* program);

/* Codes of a register are whole numbers from ninebit_lowest to ninebit_one, which stands for 1.0: -255 and 255 with
   most profiles. */
NINEBIT_PUBLIC int ninebit_one(const ninebit_program* program);
/* The lowest code of a register. */
NINEBIT_PUBLIC int ninebit_lowest(const ninebit_program* program);

/* The registers of one fragment: red, green, blue, alpha. */
typedef struct ninebit_registers {
  size_t struct_size;                 /* set by the caller */
  int16_t code[NINEBIT_REGISTERS][4]; /* by ninebit_register and component */
} ninebit_registers;

/* What reaches the combiners for one fragment, as bytes red, green, blue, alpha. */
typedef struct ninebit_inputs {
  size_t struct_size;         /* set by the caller */
  uint8_t primary[4];         /* the primary colour */
  uint8_t secondary[4];       /* the secondary colour; its alpha counts where the profile says so */
  uint8_t fog_color[3];       /* red, green, blue, whether or not fog is enabled */
  uint8_t fog_factor;         /* 255: no fog at this fragment */
  uint8_t fog_enabled;        /* 0 or 1 */
  uint8_t texture_enabled[4]; /* 0 or 1 */
  uint8_t texture[4][4];      /* texels of RGBA textures, filtered */
} ninebit_inputs;

/* The registers before the first general combiner, as the program's profile fills them. */
NINEBIT_PUBLIC ninebit_result ninebit_initial_registers(const ninebit_program* program, const ninebit_inputs* inputs,
                                                        ninebit_registers* registers, char** error);

/* Runs the program over one fragment. `color` receives what leaves the combiners, codes from 0 to ninebit_one; `after`,
   where it is not NULL, the registers after the last general combiner. */
NINEBIT_PUBLIC ninebit_result ninebit_evaluate(const ninebit_program* program, const ninebit_registers* registers,
                                               int16_t color[4], ninebit_registers* after, char** error);

/* Fragments by the thousand: a plane holds one component of one register, or of the colour, for `count` fragments. */
typedef struct ninebit_planes {
  size_t struct_size;                         /* set by the caller */
  size_t count;                               /* fragments in every plane */
  const int16_t* input[NINEBIT_REGISTERS][4]; /* NULL: 0 for every fragment */
  int16_t* color[4];                          /* NULL: not wanted; else no plane of the input */
} ninebit_planes;

/* The bits of ninebit_evaluate, by SIMD. Where a code is out of range, no plane is written. */
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
