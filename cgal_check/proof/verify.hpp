// The commands: cgal_check proof SCENE PROOF, cgal_check proof FOLDER, and cgal_check proofs.
#pragma once

#include <istream>

namespace proof {

// Writes one line; returns the exit code: 0 accepted, 1 rejected, 2 no proof of this scene, or a
// bad call, 3 an internal failure, 4 the budget is used up. The arguments are those after "proof".
int verify(int count, const char* const* arguments);

// Reads the path of a scene and that of a proof, a line each, again and again, and writes a line
// for each proof. Returns 0.
int verify_each(std::istream& calls);

}  // namespace proof
