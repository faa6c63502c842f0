// A message for people, kept by the object whose call failed.
#pragma once

#include "weir/weir.h"

typedef struct WeirMessage {
    char text[512];
} WeirMessage;

// Formats the message (cut at its length) and returns `status`, so that a check reads: return weir_fail(...).
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
WeirStatus
weir_fail(WeirMessage *message, WeirStatus status, const char *format, ...);
