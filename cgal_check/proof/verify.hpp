// The command: cgal_check proof SCENE PROOF [--jobs N].
#pragma once

namespace proof {

// Writes one line; returns the exit code: 0 accepted, 1 rejected, 2 no proof of this scene, or a
// bad call, 3 an internal failure. The arguments are those after "proof".
int verify(int count, const char* const* arguments);

}  // namespace proof
