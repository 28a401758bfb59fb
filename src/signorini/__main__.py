"""``python -m signorini COMMAND``, the same as the program ``signorini``."""

import sys

from signorini.commands.program import main

sys.exit(main())
