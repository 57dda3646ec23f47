// What sanitizers find in libraries that we call and do not build; part of sanitizer builds alone.

// A driver that is unloaded takes the pointers to what it still holds with it, and that looks like
// a leak of nobody's. So none is unloaded.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) {
  return 0;
}

// fontconfig keeps its cache, D-Bus its connection, until the process ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\nleak:libdbus\n";
}

// OpenCV loads GDAL for its picture formats; GDAL takes two locks of its own in both orders when it
// starts. It films with FFmpeg, and Pango looks for fonts in a thread of its own: code that is not
// instrumented, whose locks are not visible. Mesa draws in its own threads.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "deadlock:libgdal\nrace:libavutil\nrace:libavcodec\nrace:libfontconfig\nrace:libglib\n"
         "race:swrast_dri\n";
}
