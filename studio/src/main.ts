// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
import { mount } from 'svelte';
import App from './App.svelte';
import { Server } from './lib/server';
import './styles/tokens.css';
import './styles/studio.css';
import './styles/page.css';
import './styles/panels.css';

const target = document.getElementById('app');
if (target) mount(App, { target, props: { transport: new Server() } });
