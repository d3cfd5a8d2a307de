/* Runs a pack of `ninebit vectors --texture-shader` through an emulator's texture-shader stages.

     cc -std=c99 runner.c emulator.c -o check
     ./check vectors.txt --results results.txt

   The emulator defines the function shade: */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the stages give for a fragment. */
typedef struct {
  int16_t texture[4][4]; /* red, green, blue, alpha of units 0 to 3 as the combiners read them: a byte n is n, a signed
                            byte s is 2s */
  int culled;            /* not 0: the fragment is killed; nothing else is compared then */
  int replaces_depth;    /* not 0: `depth` replaces the fragment's */
  uint32_t depth;        /* a code of a buffer of 16 bits */
} StageResult;

/* words:  the words of the stages, in the order of the lines `word` of vectors.txt. Floats stand as their bits.
   at:     s, t, r, q of units 0 to 3, not divided by q; not to be changed.
   result: all zero at the start. */
void shade(const uint32_t words[], float at[4][4], StageResult *result);

/* The emulator may call this one: the nearest texel of a unit's texture at s, t, r, as red, green, blue, alpha. Textures
   are clamped to their edges. The kind of texture is not in the words: s and t of a rectangle count texels. */
void read_texel(int unit, const float at[3], uint8_t rgba[4]);

enum { MOST_WORDS = 64, MOST_TEXTURES = 16, MOST_FRAGMENTS = 256, MOST_GROUPS = 256, DIGITS = 32 };

typedef struct {
  char name[64], rules[64], what[256];
  unsigned long fragments, differ;
} Group;

typedef struct {
  char kind[8]; /* 1d, 2d, rect, 3d, cube */
  int width, height, depth;
  uint8_t (*texels)[4];
  size_t count;
} Texture;

static char line[65536], id[32], profile[256], word_names[MOST_WORDS][40];
static uint32_t words[MOST_WORDS];
static unsigned word_count, group_count, failing, program, fragment, texture_count;
static Group groups[MOST_GROUPS];
static Texture textures[MOST_TEXTURES];
static int units[4]; /* the textures of the program's units; -1: none */
static float at[4][4];
static int reported;
static unsigned long line_number;
static FILE *results;

static int fail(const char *message) {
  fprintf(stderr, "runner: line %lu: %s\n", line_number, message);
  return 2;
}

/* The texel of a coordinate of 0 to 1, or, of a rectangle, of 0 to size. */
static int texel_at(float coordinate, int size, int is_rectangle) {
  const float place = is_rectangle ? coordinate : coordinate * (float)size;
  if (!(place > 0.0f)) return 0;
  return place < (float)size ? (int)place : size - 1;
}

void read_texel(int unit, const float place[3], uint8_t rgba[4]) {
  const Texture *texture;
  float s = place[0], t = place[1];
  int layer = 0, is_rectangle;
  memset(rgba, 0, 4);
  if (unit < 0 || unit > 3 || units[unit] < 0) return;
  texture = &textures[units[unit]];
  if (strcmp(texture->kind, "3d") == 0) layer = texel_at(place[2], texture->depth, 0);
  if (strcmp(texture->kind, "cube") == 0) {
    const float x = place[0], y = place[1], z = place[2], ax = fabsf(x), ay = fabsf(y), az = fabsf(z);
    float major;
    if (ax >= ay && ax >= az) {
      layer = x < 0.0f, major = ax, s = x < 0.0f ? z : -z, t = -y;
    } else if (ay >= az) {
      layer = 2 + (y < 0.0f), major = ay, s = x, t = y < 0.0f ? -z : z;
    } else {
      layer = 4 + (z < 0.0f), major = az, s = z < 0.0f ? -x : x, t = -y;
    }
    s = (s / major + 1.0f) * 0.5f;
    t = (t / major + 1.0f) * 0.5f;
  }
  is_rectangle = strcmp(texture->kind, "rect") == 0;
  layer = layer * texture->height + texel_at(t, texture->height, is_rectangle);
  memcpy(rgba, texture->texels[layer * texture->width + texel_at(s, texture->width, is_rectangle)], 4);
}

/* A result as packs write it. */
static void print_result(const StageResult *result, char text[64]) {
  static const char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  int i;
  if (result->culled) {
    strcpy(text, "culled");
    return;
  }
  for (i = 0; i < 16; ++i) {
    int code = result->texture[i / 4][i % 4] + 256;
    code = code < 0 ? 0 : code > 36 * 36 - 1 ? 36 * 36 - 1 : code;
    text[2 * i] = digits[code / 36];
    text[2 * i + 1] = digits[code % 36];
  }
  text[DIGITS] = '\0';
  if (result->replaces_depth) sprintf(text + DIGITS, "/%lu", (unsigned long)result->depth);
}

static void print_codes(const char *label, const char *text) {
  int i;
  printf("  %-9s", label);
  if (strlen(text) < DIGITS) {
    printf(" %s\n", text);
    return;
  }
  for (i = 0; i < 16; ++i) {
    char pair[3] = {text[2 * i], text[2 * i + 1], '\0'};
    printf("%s%ld", i % 4 == 0 ? (i == 0 ? " " : ", ") : " ", strtol(pair, NULL, 36) - 256);
  }
  printf("%s%s\n", text[DIGITS] ? ", depth " : "", text[DIGITS] ? text + DIGITS + 1 : "");
}

static void print_report(const char *expected, const char *got) {
  const Group *group = &groups[group_count - 1];
  unsigned i;
  printf("first failing group: %s", group->name);
  if (group->rules[0] != '-') printf(" (rule%s %s)", strchr(group->rules, ',') ? "s" : "", group->rules);
  printf(": %s\n  program %u, fragment %u\n", group->what, program, fragment);
  for (i = 0; i < word_count; ++i) {
    if (words[i] != 0) printf("  %s = 0x%08lx\n", word_names[i], (unsigned long)words[i]);
  }
  for (i = 0; i < 4; ++i) {
    printf("  at%u       %.9g %.9g %.9g %.9g", i, at[i][0], at[i][1], at[i][2], at[i][3]);
    if (units[i] >= 0) printf(", texture %d (%s)", units[i], textures[units[i]].kind);
    printf("\n");
  }
  print_codes("expected", expected);
  print_codes("got", got);
  reported = 1;
}

static void run(const char *expected) {
  Group *group = &groups[group_count - 1];
  StageResult result;
  char text[64];
  memset(&result, 0, sizeof result);
  shade(words, at, &result);
  print_result(&result, text);
  ++group->fragments;
  if (strcmp(text, expected) != 0) {
    if (group->differ++ == 0) ++failing;
    if (!reported) print_report(expected, text);
  }
  if (results) fprintf(results, " %s", text);
}

static const char *read_texture(void) {
  Texture *texture = &textures[texture_count];
  unsigned index;
  if (sscanf(line, "texture %u %7s %d %d %d", &index, texture->kind, &texture->width, &texture->height,
             &texture->depth) != 5 || index != texture_count || index == MOST_TEXTURES) {
    return "a wrong texture";
  }
  if (texture->width < 1 || texture->width > 1024 || texture->height < 1 || texture->height > 1024 ||
      texture->depth < 1 || texture->depth > 64) {
    return "a wrong texture";
  }
  texture->texels = calloc((size_t)(texture->width * texture->height * texture->depth), 4);
  if (texture->texels == NULL) return "too little memory";
  ++texture_count;
  return NULL;
}

static const char *read_row(void) {
  Texture *texture = &textures[texture_count - 1];
  char *from = line + 1, *end;
  if (texture_count == 0) return "texels without a texture";
  for (;; from = end) {
    const unsigned long texel = strtoul(from, &end, 16);
    int c;
    if (end == from) return NULL;
    if (texture->count == (size_t)(texture->width * texture->height * texture->depth)) return "too many texels";
    for (c = 0; c < 4; ++c) texture->texels[texture->count][c] = (uint8_t)(texel >> (24 - 8 * c) & 255);
    ++texture->count;
  }
}

static const char *read_program(void) {
  char *from = line + 1, *end;
  unsigned index;
  unsigned long value;
  int i, length;
  const unsigned before = program;
  program = (unsigned)strtoul(from, &end, 10);
  if (end == from || group_count == 0) return "a wrong program";
  for (i = 0, from = end; i < 4; ++i) {
    from += strspn(from, " ");
    units[i] = *from == '-' ? -1 : (int)strtol(from, &end, 10);
    if (units[i] >= (int)texture_count) return "a wrong program";
    from = *from == '-' ? from + 1 : end;
  }
  memset(words, 0, sizeof words);
  while (sscanf(from, " %u=%lx%n", &index, &value, &length) == 2) {
    if (index >= MOST_WORDS) return "wrong words";
    words[index] = (uint32_t)value;
    from += length;
  }
  fragment = 0;
  if (results) fprintf(results, "%s%u", before > 0 ? "\n" : "", program);
  return from[strspn(from, " \r\n")] == '\0' ? NULL : "wrong words";
}

static const char *read_coordinates(void) {
  char *from = line + 1, *end;
  int i;
  for (i = 0; i < 16; ++i, from = end) {
    at[i / 4][i % 4] = strtof(from, &end);
    if (end == from) return "fewer than 16 coordinates";
  }
  ++fragment;
  return NULL;
}

/* Reads a line. Returns a message, or null. */
static const char *read_line(void) {
  unsigned index;
  if (strncmp(line, "group ", 6) == 0) {
    Group *group = &groups[group_count];
    if (group_count == MOST_GROUPS) return "too many groups";
    if (sscanf(line, "group %63s %63s %255[^\r\n]", group->name, group->rules, group->what) != 3) return "a wrong group";
    ++group_count;
    return NULL;
  }
  if (strncmp(line, "texture ", 8) == 0) return read_texture();
  if (strncmp(line, "x ", 2) == 0) return read_row();
  if (strncmp(line, "p ", 2) == 0) return read_program();
  if (strncmp(line, "i ", 2) == 0) return read_coordinates();
  if (strncmp(line, "o ", 2) == 0) {
    if (group_count == 0 || fragment == 0) return "a result without a fragment";
    line[strcspn(line, "\r\n")] = '\0';
    run(line + 2);
    return NULL;
  }
  if (sscanf(line, "word %u", &index) == 1 && index < MOST_WORDS) {
    if (sscanf(line, "word %*u %39s", word_names[index]) != 1) return "a word without a name";
    if (index >= word_count) word_count = index + 1;
  }
  (void)sscanf(line, "profile %255[^\r\n]", profile);
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
    if (groups[i].differ) printf("  %-40s %lu of %lu fragments\n", groups[i].name, groups[i].differ, groups[i].fragments);
  }
  printf("profile %s: %lu fragments, %lu differ; %u of %u groups pass\n", profile, ran, differ, group_count - failing,
         group_count);
  return differ ? 1 : 0;
}

int main(int argc, char **argv) {
  const char *file = NULL, *results_file = NULL;
  int i, is_complete = 0;
  FILE *in;
  for (i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--results") == 0 && i + 1 < argc) {
      results_file = argv[++i];
    } else if (file == NULL && argv[i][0] != '-') {
      file = argv[i];
    } else {
      file = NULL;
      break;
    }
  }
  if (file == NULL) {
    fprintf(stderr, "usage: %s vectors.txt [--results results.txt]\n", argv[0]);
    return 2;
  }
  in = fopen(file, "r");
  if (in == NULL) {
    perror(file);
    return 2;
  }
  if (fgets(line, sizeof line, in) == NULL || sscanf(line, "ninebit-stage-vectors 1 %31s", id) != 1) {
    fprintf(stderr, "runner: %s is not a pack of `ninebit vectors --texture-shader`\n", file);
    return 2;
  }
  line_number = 1;
  if (results_file) {
    results = fopen(results_file, "w");
    if (results == NULL) {
      perror(results_file);
      return 2;
    }
    fprintf(results, "ninebit-results 1 %s\n", id);
  }
  while (fgets(line, sizeof line, in)) {
    const char *message;
    ++line_number;
    if (strncmp(line, "end", 3) == 0) is_complete = 1;
    message = read_line();
    if (message) return fail(message);
  }
  if (results) {
    fprintf(results, "\n");
    if (fclose(results) != 0) {
      perror(results_file);
      return 2;
    }
  }
  if (!is_complete) return fail("the pack is not complete");
  return print_summary();
}
