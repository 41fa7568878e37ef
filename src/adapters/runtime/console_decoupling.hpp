/// Decouples console output: terminals, pipes and disks may block, but nodes that control motors must not.
#pragma once

namespace window_ingress::adapters {

/// Puts a separate process behind a descriptor (standard output, standard error), so that a write never
/// waits. That process passes on each line, and may itself wait for a terminal stopped by Ctrl-S, a pipe
/// without reader, or a disk that hangs. Up to 64 KB wait in a buffer; further output is lost, and
/// `consoleIsStuck` reports that. The process outlives a crash to pass on the last lines, then ends. If no
/// process can be started, nothing changes.
void decoupleOutput(int descriptor);

/// Decouples standard output and standard error of this process. Further calls have no effect. Best called
/// before anything is written.
void decoupleConsole();

/// Whether standard output or standard error is blocked.
bool consoleIsStuck();

}  // namespace window_ingress::adapters
