"""Has the two cases the wrong way round."""

# TODO B6: heavier balls with Shift
return 1 if pygame.key.get_mods() & pygame.KMOD_SHIFT else 10
# END TODO B6
