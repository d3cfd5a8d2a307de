#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]);
static char line[65536];
static int16_t inputs[4096][36];
static uint32_t base[64], words[64];
static void read_words(const char *at, uint32_t to[]) {
  unsigned index, value;
  for (int n; sscanf(at, " %u=%x%n", &index, &value, &n) == 2; at += n) to[index] = value;
}
int main(void) {
  int count = 0, first = 0, n = 0, all = 0, wrong = 0;
  FILE *file = fopen("vectors.txt", "r");
  while (file && fgets(line, sizeof line, file)) {
    char *at = line + 1;
    if (!strncmp(line, "i ", 2)) for (n = 0, ++count; n < 36; ++n) inputs[count - 1][n] = (int16_t)strtol(at, &at, 10);
    if (!strncmp(line, "base", 4)) memset(base, 0, sizeof base), read_words(line + 4, base);
    if (sscanf(line, "p %*d %d%n", &first, &n) == 1) memcpy(words, base, sizeof base), read_words(line + n, words);
    if (!strncmp(line, "o ", 2)) for (n = first; *at == ' '; ++n, ++all) {
      const unsigned long color = strtoul(at, &at, 16);
      uint8_t out[4];
      combine(words, inputs[n], out);
      wrong += color != ((unsigned long)out[0] << 24 | out[1] << 16 | out[2] << 8 | out[3]);
    }
  }
  return printf("%d of %d fragments are wrong\n", wrong, all), wrong != 0;
}
