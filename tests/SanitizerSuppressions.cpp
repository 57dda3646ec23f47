// What sanitizers find in libraries that we call and do not build; part of sanitizer builds alone.

// fontconfig keeps its cache until the process ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}

// OpenCV loads GDAL for its picture formats; GDAL takes two locks of its own in both orders when it
// starts. It films with FFmpeg, whose threads count references in code that is not instrumented.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "deadlock:libgdal\nrace:libavutil\nrace:libavcodec\n";
}
