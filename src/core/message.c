#include "core/message.h"

#include <stdarg.h>
#include <stdio.h>

// Length of the UTF-8 sequence at `text`, 0 if it is none.
static int sequence_length(const unsigned char *text)
{
    int length = *text < 0x80                    ? 1
                 : *text >= 0xc2 && *text < 0xe0 ? 2
                 : *text >= 0xe0 && *text < 0xf0 ? 3
                 : *text >= 0xf0 && *text < 0xf5 ? 4
                                                 : 0;
    for (int n = 1; n < length; ++n) {
        if ((text[n] & 0xc0) != 0x80) return 0;
    }
    return length;
}

// Messages quote what people wrote, and cut it: what is no UTF-8 any more becomes '?', so that a message can
// go into JSON as it is.
static void scrub(char *text)
{
    while (*text) {
        int length = sequence_length((const unsigned char *)text);
        if (length == 0) *text = '?';
        text += length > 0 ? length : 1;
    }
}

WeirStatus weir_fail(WeirMessage *message, WeirStatus status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
    scrub(message->text);
    return status;
}
