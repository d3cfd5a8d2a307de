/* The symbols that the shared libraries export. Everything is compiled with hidden visibility. Public headers open
   their namespace as `namespace NINEBIT_PUBLIC ninebit`, so only their declarations can be linked to. Each C function
   is marked on its own. This header is also valid C99. */
#pragma once

/* Marks a symbol that a shared library exports; empty for compilers other than GCC and Clang. */
#if defined(__cplusplus) && defined(__GNUC__)
#define NINEBIT_PUBLIC [[gnu::visibility("default")]]
#elif defined(__GNUC__)
#define NINEBIT_PUBLIC __attribute__((visibility("default")))
#else
#define NINEBIT_PUBLIC
#endif
