// Counts the users of ODE and catches its messages.
#include "sim/ode_library.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <vector>

namespace nezumi::sim {
namespace {

// ODE has one initialisation and one set of handlers per process. This is our part of that state.
struct Process {
    Mutex mutex;
    int users = 0;
    Mutex random_numbers;
    std::vector<void*>* kept = nullptr;  // never freed: these objects must exist until the process ends
};
Process& process() {
    static Process the;
    return the;
}

// ODE's handlers have no user data, so the receiver is stored per thread.
const OdeMessages::Sink*& thread_sink() {
    thread_local const OdeMessages::Sink* the = nullptr;
    return the;
}

std::string format(const char* message, va_list arguments) {
    std::array<char, 500> text{};
    std::vsnprintf(text.data(), text.size(), message, arguments);
    return std::string("physics: ") + text.data();
}

// True for a message that is no error: ODE's solver has found the contact forces if a search step has length 0 within
// rounding, but it reports this.
bool is_no_news(int number, va_list arguments) {
    if (number != d_ERR_LCP) return false;
    va_list copy;
    va_copy(copy, arguments);
    const double length = va_arg(copy, double);
    va_end(copy);
    return std::abs(length) < 1e-9;
}

void on_message(int number, const char* message, va_list arguments) {
    if (is_no_news(number, arguments)) return;
    const OdeMessages::Sink* sink = thread_sink();
    if (sink != nullptr && *sink) (*sink)(format(message, arguments));
}

// ODE ends the process if this returns.
void on_error(int, const char* message, va_list arguments) {
    const std::string text = format(message, arguments);
    if (thread_sink() != nullptr) throw OdeFailure{text};
    std::fprintf(stderr, "nezumi: %s\n", text.c_str());
}

}  // namespace

OdeLibrary::OdeLibrary() {
    Process& p = process();
    const std::scoped_lock lock(p.mutex);
    if (p.users++ == 0) {
        dInitODE2(0);
        dSetMessageHandler(on_message);
        dSetErrorHandler(on_error);
        dSetDebugHandler(on_error);
    }
    use_on_this_thread();
}

OdeLibrary::~OdeLibrary() {
    Process& p = process();
    const std::scoped_lock lock(p.mutex);
    if (--p.users == 0) dCloseODE();
}

void OdeLibrary::use_on_this_thread() { dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)); }

void OdeLibrary::keep(void* object) {
    Process& p = process();
    const std::scoped_lock lock(p.mutex);
    if (p.kept == nullptr) p.kept = new std::vector<void*>;
    p.kept->push_back(object);
}

Mutex& OdeLibrary::random_numbers() { return process().random_numbers; }

OdeMessages::OdeMessages(const Sink& sink) : before_(std::exchange(thread_sink(), &sink)) {}
OdeMessages::~OdeMessages() { thread_sink() = before_; }

}  // namespace nezumi::sim
