def test_it_is_all_right():
    pass
