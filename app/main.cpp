#include "app/commands.hpp"
#include "core/parallel/communicator.hpp"

int main(int argc, char** argv) {
    const scree::MpiSession session(&argc, &argv);
    return scree::app::run_command_line(argc, argv, scree::Communicator::world());
}
