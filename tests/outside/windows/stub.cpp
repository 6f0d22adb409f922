// Stands in for trochoid.exe: notes its arguments, and answers as the environment has it.
#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <string>

int wmain(int count, wchar_t** words) {
  std::FILE* notes = _wfopen(_wgetenv(L"STUB_NOTES"), L"ab");
  for (int i = 1; i < count; ++i) {
    char text[4096];
    WideCharToMultiByte(CP_UTF8, 0, words[i], -1, text, sizeof text, nullptr, nullptr);
    std::fprintf(notes, "%s%c", text, i + 1 < count ? '\t' : '\n');
  }
  std::fclose(notes);
  if (std::wstring(words[count - 1]).find(L"wrong") != std::wstring::npos) {
    std::fputs("case.toml:1:1: wrong\n", stderr);
    return 2;
  }
  const char* report = std::getenv("STUB_REPORT");
  if (count == 2 && report != nullptr) {
    std::printf("a table\n\nresults: somewhere\nreport:  %s\n", report);
  } else {
    std::puts("no mistakes found");
  }
  return 0;
}
