// Faults in an API: a call that luxel makes fails on demand. A test program defines the API's functions itself, each passing
// the call on to the driver unless it is the one that shall fail; the linker takes these in the driver library's place.
#pragma once
#include <dlfcn.h>

#include <map>
#include <string>

namespace luxel::faults {

inline int left = -1;         // calls until one fails; negative: none does
inline int answer = 0;        // what it returns
inline std::string struck;    // the function that failed; empty: none yet
inline std::map<std::string, int> alive;  // objects by kind: made and not yet destroyed

inline std::map<std::string, int> calls;  // since arm(), by function

/// Whether this call fails. Of a function that is called again and again the first few calls stand for all.
inline bool strikes(const char* function) {
  if (left < 0 || ++calls[function] > 4 || left-- > 0) return false;
  struck = function;
  return true;
}

/// Call number `call` from now on fails with `with`.
inline void arm(int call, int with) { left = call, answer = with, struck.clear(), calls.clear(); }
inline void disarm() { left = -1; }

/// What is left over, as text; empty: nothing.
inline std::string leaked() {
  std::string text;
  for (const auto& [kind, count] : alive)
    if (count != 0) text += (text.empty() ? "" : ", ") + kind + " " + std::to_string(count);
  return text;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace luxel::faults
