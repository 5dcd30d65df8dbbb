#include <malloc.h>

#include "app/commands/command_line.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"

int main(int argc, char** argv) {
  quartet::prepare_streams();
  quartet::handle_signals();
  // Planes of a picture come and go with every frame. Memory that goes back to the system each time
  // must come anew, page by page.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  return quartet::run_command_line(argc, argv);
}
