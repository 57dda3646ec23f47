// Suppresses findings of sanitizers in other libraries; only part of sanitizer builds.

// Unloading a driver removes its pointers to memory that it has not freed, which then counts as a
// leak. So none is unloaded.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) {
  return 0;
}

// fontconfig keeps its cache, D-Bus its connection, until the process ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\nleak:libdbus\n";
}

// GDAL, which OpenCV loads for its picture formats, takes two locks in both orders when it starts.
// OpenCV decodes with FFmpeg, and Pango looks for fonts in its own thread: their code is not
// instrumented, so that their locks are not visible. Mesa draws in its own threads.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "deadlock:libgdal\nrace:libavutil\nrace:libavcodec\nrace:libfontconfig\nrace:libglib\n"
         "race:swrast_dri\n";
}
