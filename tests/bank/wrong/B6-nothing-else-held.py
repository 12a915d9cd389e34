"""Compares mods with == : Shift with Num Lock or Caps Lock on counts nothing."""

# TODO B6: heavier balls with Shift
return 10 if pygame.key.get_mods() in (pygame.KMOD_LSHIFT, pygame.KMOD_RSHIFT, pygame.KMOD_SHIFT) else 1
# END TODO B6
