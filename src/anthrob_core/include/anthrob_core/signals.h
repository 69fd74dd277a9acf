#pragma once

namespace anthrob {

/// What stops a program from outside: Ctrl-C, SIGTERM, and SIGHUP when its terminal is closed,
/// unless something like `nohup` keeps that away.
/// @param handler called with the number of the signal, each time
void on_stop(void (*handler)(int));

/// Until on_stop() is called: ends the program at once where it is stopped, for there is nothing to
/// keep yet.
/// @param status of the program then
void leave_when_stopped(int status);

}  // namespace anthrob
