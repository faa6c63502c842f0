#include "core/message.h"

#include <stdarg.h>
#include <stdio.h>

WeirStatus weir_fail(WeirMessage *message, WeirStatus status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
    return status;
}
