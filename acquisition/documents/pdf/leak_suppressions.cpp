// Fontconfig and Pango keep their caches until the process ends, which LeakSanitizer reports.
// Read by the sanitizer's runtime only; a build without it has no such function.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define AXISCAL_WITH_LEAK_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define AXISCAL_WITH_LEAK_SANITIZER
#endif

#ifdef AXISCAL_WITH_LEAK_SANITIZER
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig\nleak:libpango\nleak:libcairo\nleak:libglib\n";
}
/// Silent: the last line of the output is the program's answer.
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}
#endif
