// A case whose answer is not legal, and what is tried on it: known faults, each with the answer that it leads to.
#pragma once

#include "cli/vectors/suite.h"

#include <functional>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// A case under suspicion.
struct Suspect {
    const Suite& suite;
    size_t index;
    const CaseRecord& record;
    const Expectation& expectation;
    const PortResult& came;

    bool looks_up() const {
        return record.op == PortOp::Sample || record.op == PortOp::Draw || record.op == PortOp::Mean || record.op == PortOp::Shade;
    }
    bool draws() const { return record.op == PortOp::Draw || record.op == PortOp::Mean; }
    const texunit::Shape& shape() const { return suite.textures[record.texture].shape(); }
};

class Detective {
  public:
    explicit Detective(const Suspect& suspect) : suspect_(suspect) {}

    /// Keeps the fault's name if it explains what came: texels and codes exactly, floats as far as precision leaves them free.
    void try_answer(const std::string& name, const PortResult& answer);
    /// The same with the texture unit's answer to the case, changed so.
    void try_change(const std::string& name, const std::function<void(CaseRecord&)>& change);
    void keep(const std::string& name);
    const std::vector<std::string>& found() const { return found_; }

  private:
    const Suspect& suspect_;
    std::vector<std::string> found_;
};

/// Indices that are wrapped by faulty code: of cases that ask for an index, of one texel, and of the four of a bilinear lookup.
void try_wraps(const Suspect& suspect, Detective& detective);

}  // namespace rawtexel::cli
