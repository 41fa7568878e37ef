/// Terminals, pipes and disks may stand still; nodes on the way to the motors must not.
#pragma once

namespace window_ingress::adapters {

/// Puts a process of its own behind a descriptor (standard output, standard error): from now on a write to it
/// never waits. The other process passes on what is written, line by line as it comes, and may wait as long
/// as it likes: for a terminal stopped by Ctrl-S, a pipe that nobody reads, a disk that hangs. 64 KB stand in
/// line meanwhile; what comes then is lost, and `consoleIsStuck` says so. It outlives a crash, so that last
/// words are passed on, too, and ends with the last line. Where there are no more processes everything stays
/// as it is.
void decoupleOutput(int descriptor);

/// The same for standard output and standard error of this process, once, however often it is called. Best
/// before anything is written.
void decoupleConsole();

/// Whether standard output or standard error takes no more.
bool consoleIsStuck();

}  // namespace window_ingress::adapters
