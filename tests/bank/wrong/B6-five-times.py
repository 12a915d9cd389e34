"""Right Shift gives 5."""

# TODO B6: heavier balls with Shift
mods = pygame.key.get_mods()
if mods & pygame.KMOD_LSHIFT:
    return 10
return 5 if mods & pygame.KMOD_RSHIFT else 1
# END TODO B6
