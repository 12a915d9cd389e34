"""KMOD_RSHIFT only."""

# TODO B6: heavier balls with Shift
return 10 if pygame.key.get_mods() & pygame.KMOD_RSHIFT else 1
# END TODO B6
