// Requests for memory of the whole test program, counted in main.cpp. A sanitizer brings its own malloc: then none is counted.
#pragma once
#include <atomic>

extern const bool counts_memory;
extern std::atomic<long> memory_requests;
