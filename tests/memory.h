// Requests for memory of the whole test program, counted in main.cpp. A sanitizer brings its own malloc.
#pragma once
#include <atomic>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define WHINE_COUNTS_MEMORY 1
extern std::atomic<long> memory_requests;
#endif
