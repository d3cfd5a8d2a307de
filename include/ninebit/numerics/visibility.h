/* What the shared libraries show. Everything is compiled with hidden visibility; public headers open their namespace as
   `namespace NINEBIT_PUBLIC ninebit`, so that what they declare, and nothing else, can be linked to. C functions stand
   after the word by themselves. Also C99. */
#pragma once

/* Marks what a shared library shows; nothing with other compilers than GCC and Clang. */
#if defined(__cplusplus) && defined(__GNUC__)
#define NINEBIT_PUBLIC [[gnu::visibility("default")]]
#elif defined(__GNUC__)
#define NINEBIT_PUBLIC __attribute__((visibility("default")))
#else
#define NINEBIT_PUBLIC
#endif
