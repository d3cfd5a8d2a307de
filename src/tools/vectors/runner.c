/* Runs a pack of `ninebit vectors` through an emulator's register combiners.

     cc -std=c99 runner.c emulator.c -o check
     ./check vectors.txt --results results.txt

   The emulator defines this function: */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* words: the registers of the chip, in the order of the lines `word` of vectors.txt.
   in:    36 codes before the first general combiner: red, green, blue, alpha of fog, primary and secondary colour,
          spare0, spare1, textures 0 to 3. A byte n is n. Textures may be negative where the chip has signed texels:
          a signed byte s is 2s. 1.0 is the number of the line `one`, 255 for most profiles. spare0's alpha is that of
          texture 0; the rest of spare0, and spare1, are 0.
   out:   red, green, blue, alpha as bytes. */
void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]);

/* Where they stand. Word k of stage s of an NV20 class chip is words[NV20_STAGES + NV20_EACH * s + k]. */
enum { NV20_ENABLE, NV20_FINAL0, NV20_FINAL1, NV20_COLOR0, NV20_COLOR1, NV20_STAGES };
enum { NV10_FINAL0, NV10_FINAL1, NV10_COLOR0, NV10_COLOR1, NV10_STAGES };
enum { IN_RGB, OUT_RGB, IN_ALPHA, OUT_ALPHA, NV10_EACH, STAGE_COLOR0 = NV10_EACH, STAGE_COLOR1, NV20_EACH };

/* The names of an NV20 class chip's words: the pack's, xemu's and nv2a-trace's, or the registers' addresses. */
typedef enum { LAYOUT_NAMES, LAYOUT_PGRAPH, LAYOUT_ADDRESS } Layout;

/* Prints a program as lines NAME = 0xVALUE, which `ninebit explain` reads. */
void print_words(FILE *to, const uint32_t words[], Layout layout);

/* Compiled with -DCOMBINE_STAGE, this one too: the 36 codes after general combiner `stage`, in the order of `in`. The
   runner then names the first stage and register that is wrong. */
#ifdef COMBINE_STAGE
void combine_stage(const uint32_t words[], const int16_t in[], int stage, int16_t out[36]);
#endif

enum { MOST_WORDS = 64, MOST_INPUTS = 4096, CODES = 36, MOST_FRAGMENTS = 256, MOST_GROUPS = 256, MOST_STAGES = 8 };

typedef struct {
  char name[64], rules[64], what[256];
  unsigned long fragments, differ;
} Group;

static char line[65536], id[32], profile[256], word_names[MOST_WORDS][40];
static uint32_t base[MOST_WORDS], words[MOST_WORDS];
static int16_t inputs[MOST_INPUTS][CODES];
static unsigned fragments, input_count, word_count, group_count, failing, program, first_input;
static Group groups[MOST_GROUPS];
static uint8_t expected[MOST_FRAGMENTS][4], got[MOST_FRAGMENTS][4];
static char traces[MOST_STAGES][65536]; /* the lines `s` of the program whose report is printed */
static unsigned trace_count, wanted;    /* fragment of the report plus one; 0: no report is being made */
static int reported;
static unsigned long printed; /* the program that --print names; 0: none */
static const char *const registers[] = {"fog",    "primary", "secondary", "spare0", "spare1",
                                        "tex0",   "tex1",    "tex2",      "tex3"};
static unsigned long line_number;
static FILE *results;

static int fail(const char *message) {
  fprintf(stderr, "runner: line %lu: %s\n", line_number, message);
  return 2;
}

/* Reads INDEX=HEX pairs. Returns 0 if one is wrong. */
static int read_words(const char *at, uint32_t to[]) {
  unsigned index;
  unsigned long value;
  int length;
  while (sscanf(at, " %u=%lx%n", &index, &value, &length) == 2) {
    if (index >= MOST_WORDS) return 0;
    to[index] = (uint32_t)value;
    at += length;
  }
  return at[strspn(at, " \r\n")] == '\0';
}

static int base36(int digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; }

/* Goes to the fragment's codes in a line `s`; they follow as two digits each. */
static const char *codes_of(const char *trace, unsigned fragment, char mask[16]) {
  int length = 0;
  unsigned stage;
  if (sscanf(trace, "s %u %15s%n", &stage, mask, &length) != 2) return NULL;
  trace += length;
  for (; fragment > 0 && *trace != '\0'; --fragment) {
    trace += 1 + strspn(trace, " ");
    trace += strcspn(trace, " \r\n");
  }
  return trace + strspn(trace, " ");
}

#ifdef COMBINE_STAGE
static int16_t own[CODES];
static int is_wrong;
static void run_stage(int stage, unsigned fragment) {
  memset(own, 0, sizeof own);
  combine_stage(words, inputs[first_input + fragment], stage, own);
}
/* Prints the emulator's code where it first differs. */
static void compare(unsigned index, int code) {
  if (own[index] == code) return;
  if (!is_wrong) printf(" (yours is %d)", own[index]);
  is_wrong = 1;
}
#else
static void run_stage(int stage, unsigned fragment) {
  (void)stage;
  (void)fragment;
}
static void compare(unsigned index, int code) {
  (void)index;
  (void)code;
}
#endif

/* Prints what each stage should have written. */
static void print_trace(unsigned fragment) {
  unsigned i, r, c;
  for (i = 0; i < trace_count; ++i) {
    char mask[16];
    const char *at = codes_of(traces[i], fragment, mask);
    const int stage = traces[i][2] - '0';
    if (at == NULL) return;
    run_stage(stage, fragment);
    printf("  after stage %d:", stage);
    for (r = 0; r < 9; ++r) {
      const int bits = base36(mask[r]);
      for (c = 0; c < 4; ++c) {
        int code;
        if (!(bits & (8 >> c)) || strlen(at) < 2) continue;
        code = base36(at[0]) * 36 + base36(at[1]) - 256;
        at += 2;
        printf(" %s.%c %d", registers[r], "rgba"[c], code);
        compare(4 * r + c, code);
      }
    }
    printf("\n");
  }
}

typedef struct {
  unsigned long address;
  const char *name;
} Place;

void print_words(FILE *to, const uint32_t values[], Layout layout) {
  static const Place once[NV20_STAGES] = {{0x401940, "COMBINECTL"},
                                          {0x401944, "COMBINESPECFOG0"},
                                          {0x401948, "COMBINESPECFOG1"},
                                          {0x4019ac, "SPECFOGFACTOR0"},
                                          {0x4019b0, "SPECFOGFACTOR1"}};
  static const Place each[NV20_EACH] = {{0x401900, "COMBINECOLORI0"}, {0x401920, "COMBINECOLORO0"},
                                        {0x4018c0, "COMBINEALPHAI0"}, {0x4018e0, "COMBINEALPHAO0"},
                                        {0x401880, "COMBINEFACTOR0"}, {0x4018a0, "COMBINEFACTOR1"}};
  const int is_nv20 = strcmp(word_names[0], "RC_ENABLE") == 0;
  const unsigned stages = (unsigned)(values[NV20_ENABLE] & 15);
  const unsigned count = is_nv20 ? NV20_STAGES + NV20_EACH * stages : word_count;
  unsigned i;
  for (i = 0; i < count && i < word_count; ++i) {
    const unsigned stage = i < NV20_STAGES ? 0 : (i - NV20_STAGES) / NV20_EACH;
    const Place *const place = i < NV20_STAGES ? &once[i] : &each[(i - NV20_STAGES) % NV20_EACH];
    if (!is_nv20 || layout == LAYOUT_NAMES) {
      fprintf(to, "%s", word_names[i]);
    } else if (layout == LAYOUT_ADDRESS) {
      fprintf(to, "0x%lx", place->address + 4 * stage);
    } else {
      fprintf(to, "NV_PGRAPH_%s", place->name);
      if (i >= NV20_STAGES) fprintf(to, "[%u]", stage);
    }
    fprintf(to, " = 0x%08lx\n", (unsigned long)values[i]);
  }
}

static void print_report(unsigned fragment) {
  const Group *group = &groups[group_count - 1];
  const int16_t *in = inputs[first_input + fragment];
  unsigned i, c;
  printf("first failing group: %s", group->name);
  if (group->rules[0] != '-') printf(" (rule%s %s)", strchr(group->rules, ',') ? "s" : "", group->rules);
  printf(": %s\n  program %u, fragment %u\n", group->what, program, fragment + 1);
  for (i = 0; i < word_count; ++i) {
    if (words[i] != 0) printf("  %s = 0x%08lx\n", word_names[i], (unsigned long)words[i]);
  }
  for (i = 0; i < 9; ++i) {
    printf("  %-9s", registers[i]);
    for (c = 0; c < 4; ++c) printf(" %4d", in[4 * i + c]);
    printf("\n");
  }
  print_trace(fragment);
  printf("  expected %d %d %d %d\n  got      %d %d %d %d\n", expected[fragment][0], expected[fragment][1],
         expected[fragment][2], expected[fragment][3], got[fragment][0], got[fragment][1], got[fragment][2],
         got[fragment][3]);
  reported = 1;
}

/* Runs the program whose expected colours the line `o` has. Returns 0 if the line is wrong. */
static int run(char *at) {
  Group *group = &groups[group_count - 1];
  unsigned i, c;
  if (results) fprintf(results, "%u", program);
  for (i = 0; i < fragments; ++i) {
    char *end;
    const unsigned long color = strtoul(at, &end, 16);
    if (end == at) return 0;
    at = end;
    for (c = 0; c < 4; ++c) expected[i][c] = (uint8_t)(color >> (24 - 8 * c) & 255);
    memset(got[i], 0, sizeof got[i]);
    combine(words, inputs[first_input + i], got[i]);
    ++group->fragments;
    if (memcmp(got[i], expected[i], 4) != 0) {
      if (group->differ == 0) ++failing;
      ++group->differ;
      if (!reported && !wanted) wanted = i + 1;
    }
    if (results) fprintf(results, " %02x%02x%02x%02x", got[i][0], got[i][1], got[i][2], got[i][3]);
  }
  if (results) fprintf(results, "\n");
  trace_count = 0;
  return 1;
}

/* Reads a line of the header. Returns a message, or null. */
static const char *read_header(void) {
  unsigned index;
  if (sscanf(line, "word %u", &index) == 1 && index < MOST_WORDS) {
    if (sscanf(line, "word %*u %39s", word_names[index]) != 1) return "a word without a name";
    if (index >= word_count) word_count = index + 1;
  }
  if (sscanf(line, "profile %255[^\r\n]", profile) == 1) return NULL;
  if (sscanf(line, "fragments %u", &fragments) == 1 && fragments > MOST_FRAGMENTS) return "too many fragments";
  if (strncmp(line, "i ", 2) == 0) {
    char *at = line + 1, *end;
    int i;
    if (input_count == MOST_INPUTS) return "too many inputs";
    for (i = 0; i < CODES; ++i) {
      const long code = strtol(at, &end, 10);
      if (end == at) return "an input has fewer than 36 codes";
      inputs[input_count][i] = (int16_t)code;
      at = end;
    }
    ++input_count;
  }
  return NULL;
}

/* Reads a line. Returns a message, or null. */
static const char *read_line(void) {
  int length = 0;
  if (wanted && strncmp(line, "s ", 2) != 0) {
    print_report(wanted - 1);
    wanted = 0;
  }
  if (strncmp(line, "group ", 6) == 0) {
    Group *group = &groups[group_count];
    if (group_count == MOST_GROUPS) return "too many groups";
    if (sscanf(line, "group %63s %63s %255[^\r\n]", group->name, group->rules, group->what) != 3) return "a wrong group";
    ++group_count;
  } else if (strncmp(line, "base", 4) == 0) {
    memset(base, 0, sizeof base);
    if (!read_words(line + 4, base)) return "wrong words";
  } else if (strncmp(line, "p ", 2) == 0) {
    memcpy(words, base, sizeof words);
    if (sscanf(line, "p %u %u%n", &program, &first_input, &length) != 2) return "a wrong program";
    if (first_input + fragments > input_count || group_count == 0) return "a wrong program";
    if (!read_words(line + length, words)) return "wrong words";
  } else if (printed != 0) {
    return strncmp(line, "o ", 2) == 0 || strncmp(line, "s ", 2) == 0 ? NULL : read_header();
  } else if (strncmp(line, "o ", 2) == 0) {
    if (group_count == 0 || !run(line + 1)) return "a wrong line of colours";
  } else if (strncmp(line, "s ", 2) == 0) {
    if (wanted && trace_count < MOST_STAGES) strcpy(traces[trace_count++], line);
  } else {
    return read_header();
  }
  return NULL;
}

static int print_summary(void) {
  unsigned long ran = 0, differ = 0;
  unsigned i;
  for (i = 0; i < group_count; ++i) {
    ran += groups[i].fragments;
    differ += groups[i].differ;
  }
  if (failing) printf("groups that differ:\n");
  for (i = 0; i < group_count; ++i) {
    if (groups[i].differ) printf("  %-28s %lu of %lu fragments\n", groups[i].name, groups[i].differ, groups[i].fragments);
  }
  printf("profile %s: %lu fragments, %lu differ; %u of %u groups pass\n", profile, ran, differ, group_count - failing,
         group_count);
  return differ ? 1 : 0;
}

static int wrong_usage(const char *name) {
  fprintf(stderr, "usage: %s vectors.txt [--results FILE] [--print PROGRAM [--pgraph|--address]]\n"
                  "PROGRAM is a number from 1 on.\n", name);
  return 2;
}

int main(int argc, char **argv) {
  const char *file = NULL, *results_file = NULL;
  Layout layout = LAYOUT_NAMES;
  int i, is_complete = 0;
  FILE *in;
  for (i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--results") == 0 && i + 1 < argc) {
      results_file = argv[++i];
    } else if (strcmp(argv[i], "--print") == 0 && i + 1 < argc) {
      char *end;
      printed = strtoul(argv[++i], &end, 10);
      if (printed == 0 || *end != '\0') return wrong_usage(argv[0]);
    } else if (strcmp(argv[i], "--pgraph") == 0) {
      layout = LAYOUT_PGRAPH;
    } else if (strcmp(argv[i], "--address") == 0) {
      layout = LAYOUT_ADDRESS;
    } else if (file == NULL && argv[i][0] != '-') {
      file = argv[i];
    } else {
      file = NULL;
      break;
    }
  }
  if (file == NULL || (layout != LAYOUT_NAMES && printed == 0)) return wrong_usage(argv[0]);
  in = fopen(file, "r");
  if (in == NULL || fgets(line, sizeof line, in) == NULL || sscanf(line, "ninebit-vectors 1 %31s", id) != 1) {
    fprintf(stderr, "runner: cannot read a pack from %s\n", file);
    return 2;
  }
  if (results_file != NULL) {
    results = fopen(results_file, "w");
    if (results == NULL) {
      fprintf(stderr, "runner: cannot write %s\n", results_file);
      return 2;
    }
    fprintf(results, "ninebit-results 1 %s\n", id);
  }
  for (line_number = 2; !is_complete && fgets(line, sizeof line, in) != NULL; ++line_number) {
    const char *message = read_line();
    if (message != NULL) return fail(message);
    if (printed != 0 && program == printed) {
      print_words(stdout, words, layout);
      return 0;
    }
    is_complete = strncmp(line, "end", 3) == 0;
  }
  fclose(in);
  if (!is_complete) return fail("the pack is cut off: 'end' is missing");
  if (printed != 0) return fail("the pack does not have the program that --print names");
  if (results != NULL && (ferror(results) != 0) + (fclose(results) != 0) != 0) {
    fprintf(stderr, "runner: cannot write %s\n", results_file);
    return 2;
  }
  return print_summary();
}
